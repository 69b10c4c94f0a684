"""Push the corner stones together: every rearrangement of the contact network, exactly."""

from lcp_piles import push_path

path = push_path("nt30", 6, floor_compliance="-1/2")  # the floor of the paper's Table 1
last = path.rearrangements[-1].push

if __name__ == "__main__":
    for number, change in enumerate(path.rearrangements, 1):
        print(f"{number:>2}  push {float(change.push):12.6f} = {change.push}")
    print(f"force under disc (6,8) at a push of 100: {path.force((6, 8), 'floor', 100)} w")
