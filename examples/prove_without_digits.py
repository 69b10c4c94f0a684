"""Which contacts carry a force, proved, with rigorous bounds: for piles too large for digits."""

from lcp_piles import prove_contacts, tbs

proof = prove_contacts(tbs(40))
carrying = int(proof.loaded.sum())

if __name__ == "__main__":
    print(f"proved: {proof.proved}; {carrying} contacts carry a force")
    print(f"every force within {proof.forces.radius.max():.1e} w")
