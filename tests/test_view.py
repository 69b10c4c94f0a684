"""The interactive page: what is in it, and what a real browser shows of it."""

from __future__ import annotations

import base64
import json
import re
import shutil
import struct
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from lcp_piles import (
    Contact,
    Disc,
    InputError,
    NotSolvedError,
    Scene,
    Solution,
    contact_bounds,
    nt30,
    push_path,
    solve,
    surd,
    tetrahedron,
    view,
)
from lcp_piles.cli.parser import main
from lcp_piles.friction.force_bounds import ContactBounds
from lcp_piles.interactive.page_data import ROOM, page_data
from lcp_piles.push.push_path import PushPath
from lcp_piles.scenes.names import contact_name

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")


@pytest.fixture(scope="module")
def pile() -> Solution:
    return solve(nt30(4))


@pytest.fixture(scope="module")
def path() -> PushPath:
    return push_path("nt30", 4)


def embedded(html: str) -> dict:
    """What the page's script reads."""
    found = re.findall(r'<script type="application/json" id="data">([^<]*)</script>', html)
    assert len(found) == 1
    return json.loads(found[0])


def floats(series: dict) -> list[list[float]]:
    """The rows of all entries, unpacked by other means than the script's."""
    raw = base64.b64decode(series["rows"])
    numbers = struct.unpack(f"<{len(raw) // 4}f", raw)
    width = series["columns"]
    return [list(numbers[k * width : (k + 1) * width]) for k in series["of"]]


def test_every_number_of_the_solution_is_in_the_page(pile: Solution) -> None:
    data = embedded(view(pile).html)
    for name, vector in (
        ("force", pile.forces),
        ("gap", pile.gaps),
        ("shift", pile.displacements),
    ):
        series = data["start"][name]
        assert [surd(data["texts"][k]) for k in series["text"][0]] == list(vector)
        drawn = [row[0] for row in floats(series)]
        assert drawn == pytest.approx([float(x) for x in vector], rel=1e-6)
    assert [c[0] for c in data["contacts"]] == [
        contact_name((c.a, c.b)) for c in pile.scene.contacts
    ]


def test_every_piece_of_the_path_is_in_the_page(pile: Solution, path: PushPath) -> None:
    """The forces of the corners, from `PushPath.force`, and gaps that fit the loaded contacts."""
    page = embedded(view(pile, push=path).html)
    data, texts = page["path"], page["texts"]
    pushes = [surd(texts[k]) for k in data["push"]["text"][0]]
    assert data["whole"] == len(path.path.segments) == len(pushes) - 1
    assert pushes[1:-1] == [r.push for r in path.rearrangements]
    assert [list(map(len, c)) for c in data["changes"][1:-1]] == [
        [len(r.opens), len(r.closes)] for r in path.rearrangements
    ]
    for corner, push in enumerate(pushes):
        found = [surd(texts[k]) for k in data["force"]["text"][corner]]
        assert found == [path.force(c.a, c.b, push) for c in pile.scene.contacts]
    for piece in range(len(pushes) - 1):
        middle = path.solution((pushes[piece] + pushes[piece + 1]) / 2)
        for k, state in enumerate(middle.states):
            loaded = any(floats(data["force"])[k][piece : piece + 2])
            apart = any(floats(data["gap"])[k][2 * piece : 2 * piece + 2])
            assert ("closed" if loaded else "open" if apart else "osculatory") == state


def test_a_long_path_keeps_as_much_text_as_there_is_room_for(
    pile: Solution, path: PushPath, monkeypatch
) -> None:
    monkeypatch.setattr("lcp_piles.interactive.page_data.ROOM", 5000)
    data = page_data(pile, path)
    whole = data["path"]["whole"]
    assert 0 < whole < len(path.path.segments)
    assert len(data["path"]["force"]["text"]) == whole + 1
    assert data["path"]["shift"]["columns"] == 2 * whole
    assert data["path"]["force"]["columns"] == len(path.path.segments) + 1


def test_nothing_in_a_scene_can_write_the_page() -> None:
    evil = "</script><script>alert(1)</script><!--__DATA__"
    ball = Disc(evil, (0, 0), (0, -1), (None, None))
    scene = Scene([ball], [Contact(evil, evil + "'", (0, 1))], supports=(evil + "'",))
    html = view(solve(scene)).html
    assert html.count("<script") == 2
    assert html.count("alert(1)") == 3  # as disc, twice in the contact
    assert embedded(html)["contacts"][0][0] == f"{evil}-{evil}'"
    framed = view(solve(scene))._repr_html_()
    assert framed.startswith('<iframe sandbox="allow-scripts"')
    assert framed.count("<") == 2  # the frame and its end


def test_the_page_asks_for_nothing(pile: Solution, path: PushPath) -> None:
    html = view(pile, push=path).html
    assert "default-src 'none'" in html
    outside = re.findall(r"https?://[^\"' ]*", html)
    assert set(outside) == {"http://www.w3.org/2000/svg"}  # a name, not an address


def test_nt30_of_six_layers_with_its_path_is_below_a_megabyte() -> None:
    html = view(solve(nt30(6)), push=push_path("nt30", 6)).html
    assert len(html.encode()) < 1_000_000


@pytest.mark.slow
def test_nt30_of_twenty_layers_with_its_path_is_below_four_megabytes() -> None:
    path = push_path("nt30", 20)
    assert len(path.rearrangements) == 323
    html = view(solve(nt30(20)), push=path).html
    assert ROOM < len(html.encode()) < 4_000_000


def test_what_cannot_be_shown_is_refused(pile: Solution, path: PushPath, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="that of the solution"):
        view(solve(nt30(3)), push=path)
    with pytest.raises(InputError, match="only plane scenes"):
        view(solve(tetrahedron(2)))
    with pytest.raises(InputError, match=r"ends in \.html"):
        view(pile, tmp_path / "pile.png")
    nothing = Scene([Disc("a", (0, 0), (0, -1), (None, None))], [])
    with pytest.raises(NotSolvedError):
        view(solve(nothing))


def test_the_command_writes_what_the_function_makes(tmp_path: Path, capsys) -> None:
    file = tmp_path / "pile.html"
    words = ["view", "nt30", "--layers", "3", "--push", "1", "--push-path", "--out", str(file)]
    assert main([*words, "--friction", "1/10"]) == 0
    scene = nt30(3, push=1)
    page = view(
        solve(scene), push=push_path("nt30", 3, start=1), bounds=contact_bounds(scene, "1/10")
    )
    assert file.read_text(encoding="utf-8") == page.html
    assert main(["view", "silo", "--push-path", "--out", str(file)]) == 2
    assert main(["view", "nt30", "--rough", "--out", str(file)]) == 2
    assert "nt30, nt60" in capsys.readouterr().err


@pytest.fixture(scope="module")
def browser() -> Iterator[object]:
    """A Chromium without a window; the tests that need it are skipped where there is none."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="needs the extra browser")
    if CHROMIUM is None or DRIVER is None:
        pytest.skip("no chromium and chromedriver are installed")
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(DRIVER))
    yield driver
    driver.quit()


@pytest.fixture(scope="module")
def bounds(pile: Solution) -> ContactBounds:
    return contact_bounds(pile.scene, "1/10")


@pytest.fixture
def page(browser, pile: Solution, path: PushPath, bounds, tmp_path: Path) -> SimpleNamespace:
    """The page of a pile with its path and bounds, loaded, and words for what a person does."""
    file = tmp_path / "pile.html"
    view(pile, file, push=path, bounds=bounds)
    browser.get(file.as_uri())
    run = browser.execute_script

    def press(selector: str, *keys: str) -> None:
        from selenium.webdriver.common.keys import Keys

        for key in keys:
            word = getattr(Keys, key) if key.isupper() else key
            browser.find_element("css selector", selector).send_keys(word)

    return SimpleNamespace(
        browser=browser,
        bounds=bounds,
        run=run,
        press=press,
        details=lambda: run("return document.getElementById('details').textContent"),
        where=lambda: run("return document.getElementById('where').textContent"),
        hover=lambda what, k: run(
            "document.querySelectorAll(arguments[0])[arguments[1]]"
            ".dispatchEvent(new PointerEvent('pointerenter'))",
            what,
            k,
        ),
    )


def test_hover_shows_exact_numbers(page: SimpleNamespace, pile: Solution) -> None:
    for k in range(0, len(pile.forces), 7):
        page.hover(".hit", k)
        contact = pile.scene.contacts[k]
        text = page.details()
        assert text.startswith(
            f"contact{contact_name((contact.a, contact.b))}state{pile.states[k]}"
            f"force{pile.forces[k]} w"
        )
        assert f"gap{pile.gaps[k]} w tau" in text
        least, largest = page.bounds.least[k], page.bounds.largest[k]
        end = "no largest" if largest is None else f"{largest} w"
        assert text.endswith(f"from {least} to {end}")
    page.hover(".disc", 5)
    x, y = pile.displacements[10], pile.displacements[11]
    assert f"displacement x{x} w tau" in page.details()
    assert f"displacement y{y} w tau" in page.details()
    assert page.browser.get_log("browser") == []


def test_a_bar_of_the_base_and_its_disc_go_together(page: SimpleNamespace, pile: Solution) -> None:
    page.hover(".place", 0)
    lit = page.run("return document.querySelectorAll('.disc.linked').length")
    assert (lit, page.run("return document.querySelectorAll('.bar.now').length")) == (1, 1)
    disc = page.details().split("of disc")[1]
    ids = {f"({i},{j})": (i, j) for i, j in (d.id for d in pile.scene.discs)}
    assert (
        f"force on the base{pile.forces[pile.contact_index(ids[disc], 'floor')]} w"
        in page.details()
    )


def test_bars_stand_below_their_discs(page: SimpleNamespace) -> None:
    middle = """
        const box = arguments[0].getBoundingClientRect();
        return box.left + box.width / 2"""
    find = page.browser.find_elements
    bars, discs = find("css selector", ".bar"), find("css selector", ".disc")
    base = page.run("return JSON.parse(document.getElementById('data').textContent).base")
    for bar in (0, len(bars) - 1):
        disc = discs[base[bar][0]]
        assert abs(page.run(middle, bars[bar]) - page.run(middle, disc)) < 1


def test_keys_go_over_contacts_discs_and_bars(page: SimpleNamespace, pile: Solution) -> None:
    """Every contact of the lowest row can be reached, from left to right, by one key."""
    page.press(".hit[tabindex='0']", "END")
    last = contact_name((pile.scene.contacts[-1].a, pile.scene.contacts[-1].b))
    assert page.details().startswith(f"contact{last}")
    focused = "return document.activeElement.getAttribute('aria-label')"
    assert page.run(focused).startswith(f"contact {last}, state")
    seen = {page.details()}
    for _ in range(4):
        page.press(".hit[tabindex='0']", "ARROW_LEFT")
        seen.add(page.details())
    assert len(seen) == 5
    page.press(".hit[tabindex='0']", "d")
    assert page.details().startswith("disc")
    page.press(".disc[tabindex='0']", "ARROW_UP", "c")
    assert page.details().startswith("contact")
    page.press(".bar[tabindex='0']", "ARROW_RIGHT")
    assert page.details().startswith("force on the base")
    stops = "return document.querySelectorAll('svg [tabindex=\"0\"]').length"
    assert page.run(stops) == 3


def test_the_slider_goes_over_the_path(page: SimpleNamespace, path: PushPath) -> None:
    """Breakpoints by PageUp, named with what changes; between them the exact force of the path."""
    first, second = (r.push for r in path.rearrangements[:2])
    page.press("#push", "PAGE_UP")
    change = path.rearrangements[0]
    what, contacts = ("closes", change.closes) if change.closes else ("opens", change.opens)
    names = ", ".join(contact_name((c.a, c.b)) for c in contacts)
    assert page.where().startswith(f"breakpoint 1 of {len(path.rearrangements)}: ")
    assert f"{what} {names}" in page.where()
    assert f"; push {first} (about " in page.where()
    assert page.run("return document.querySelectorAll('.changed').length") == len(
        change.opens + change.closes
    )
    page.press("#push", *["ARROW_RIGHT"] * 3)
    push = (first * 5 + second * 3) / 8
    assert page.where().startswith("between breakpoint 1 and breakpoint 2; ")
    assert f"; push {push} (about " in page.where()
    for k in range(0, len(path.scene.contacts), 9):
        contact = path.scene.contacts[k]
        page.hover(".hit", k)
        assert f"force{path.force(contact.a, contact.b, push)} w" in page.details()
    page.press("#push", "END")
    assert "the end" in page.where()
    page.press("#push", "HOME")
    page.run("document.getElementById('play').click()")
    assert page.run("return document.getElementById('play').textContent") == "Pause"
    page.browser.execute_async_script("setTimeout(arguments[0], 400)")
    page.run("document.getElementById('play').click()")
    assert 1 <= int(page.run("return document.getElementById('push').value")) <= 6
    assert page.browser.get_log("browser") == []


def test_two_states_without_force_look_different(page: SimpleNamespace) -> None:
    """Apart by their dashes, not by colour alone."""
    dashes = """
        const looks = ['open', 'osculatory'].map((state) => {
          const line = document.querySelector('.contact');
          line.setAttribute('class', 'contact ' + state);
          return getComputedStyle(line).strokeDasharray;
        });
        return looks"""
    one, two = page.run(dashes)
    assert one != two
    assert "none" not in (one, two)


def test_a_phone_shows_it_without_scrolling_sideways(page: SimpleNamespace) -> None:
    size = {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True}
    page.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    wide = page.run("return document.documentElement.scrollWidth")
    page.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    assert wide <= 390


def test_osculatory_contacts_are_named_as_such(browser, path: PushPath, tmp_path: Path) -> None:
    """At a breakpoint the contact that closes there touches and carries nothing yet."""
    pile = path.solution(path.rearrangements[0].push)
    k = pile.states.index("osculatory")
    file = tmp_path / "pile.html"
    view(pile, file)
    browser.get(file.as_uri())
    hit = "document.querySelectorAll('.hit')[arguments[0]]"
    browser.execute_script(f"{hit}.dispatchEvent(new PointerEvent('pointerenter'))", k)
    text = browser.execute_script("return document.getElementById('details').textContent")
    assert "stateosculatoryforce0 wgap0 w tau" in text
    assert browser.execute_script("return document.getElementById('travel').hidden")
