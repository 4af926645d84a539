#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_page.py FOLDER [PICTURES]: opens FOLDER/page.html in a headless Chromium and works with it as a user would, by
mouse, keyboard and touch. FOLDER/truth.txt has one line a point: view, u, v, then as the matcher has them the tissue's depth, the
nipple's distance, the first and last point of the curve, its length and the smallest u of the arc, mm. Screenshots go to PICTURES."""

from __future__ import annotations

import math
import pathlib
import sys
from typing import Any

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from browser import Browser, chromium  # noqa: E402

CONTROL = 2
failures: list[str] = []


def check(holds: Any, what: str) -> None:
    if not holds:
        failures.append(what)
        print("FAIL:", what)


def near(value: float, expected: float, tolerance: float, what: str) -> None:
    check(abs(value - expected) <= tolerance, f"{what}: {value:.3f} where {expected:.3f} +- {tolerance} is expected")


class Page:
    def __init__(self, browser: Browser, file: pathlib.Path) -> None:
        self.browser, self.address = browser, file.resolve().as_uri()
        self.value = browser.value

    def open(self, width: int, height: int, touch: bool = False, points: str = "") -> None:
        self.browser.size(width, height, touch)
        self.browser.open(self.address + ("#" + points if points else ""))
        while not self.value("performance.getEntriesByName('first picture').length"):
            self.browser.frame()
        self.to_pointing()

    def to_pointing(self) -> None:
        self.value("document.getElementById('tools').scrollIntoView()")
        self.browser.frame()

    def index(self, view: str) -> int:
        return self.value(f"views.findIndex(view => view.image.view === '{view}')")

    def screen(self, k: int, u: float, v: float) -> tuple[float, float]:
        return tuple(self.value(
            f"(() => {{ const box = views[{k}].canvas.getBoundingClientRect(), [x, y] = views[{k}].toScreen({u}, {v});"
            f" return [box.left + views[{k}].canvas.clientLeft + x, box.top + views[{k}].canvas.clientTop + y]; }})()"))

    def pins(self) -> int:
        return self.value("document.querySelectorAll('#pins li').length")

    def coloured(self, canvas: str, colour: str) -> int:
        """Pixels of a canvas within a few steps of a colour, #rrggbb."""
        rgb = [int(colour[i:i + 2], 16) for i in (1, 3, 5)]
        return self.value(
            f"(() => {{ const c = document.getElementById('{canvas}'), p = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
            f" let n = 0; for (let i = 0; i < p.length; i += 4) n += Math.abs(p[i] - {rgb[0]}) + Math.abs(p[i + 1] - {rgb[1]}) +"
            f" Math.abs(p[i + 2] - {rgb[2]}) < 40; return n; }})()")

    def mean_grey(self, canvas: str) -> float:
        return self.value(
            f"(() => {{ const c = document.getElementById('{canvas}'), p = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
            " let n = 0; for (let i = 0; i < p.length; i += 4) n += p[i]; return 4 * n / p.length; })()")


def check_against_matcher(page: Page, truth: list[list[str]]) -> None:
    """Every point clicked in its view: the other view's curve, depth, nipple distance and arc as the matcher has them."""
    for number, (view, *numbers) in enumerate(truth, 1):
        u, v, depth, nipple, *ends, length, arc = map(float, numbers)
        k = page.index(view)
        page.browser.click(*page.screen(k, u, v))
        check(page.pins() == number, f"click {number} in {view} keeps a point")
        page.value("hover = null, drawAll()")
        curve = [tuple(map(float, p.split())) for p in page.value("document.getElementById('readout').dataset.curve").split(";")]
        name = f"{view} {u:.1f}, {v:.1f}"
        # A click falls on a whole pixel: the truth is compared at the place that was hit.
        hit = page.value(f"[pins[{number - 1}].u, pins[{number - 1}].v]")
        near(math.dist(hit, (u, v)), 0, 0.6, f"{name}: place of the click, mm")
        exact = page.value(f"(() => {{ const p = found({k}, {u}, {v}); return [p.match.curve, p.match.depth,"
                           f" nippleDistance({k}, {u}, {v}), Math.min(...p.arc.flat().map(a => a[0])), p.match.length]; }})()")
        near(exact[1], depth, 0.3, f"{name}: depth")
        near(exact[2], nipple, 0.01, f"{name}: distance from the nipple")
        near(math.dist(exact[0][0], ends[:2]), 0, 0.3, f"{name}: the curve's first point")
        near(math.dist(exact[0][-1], ends[2:]), 0, 0.3, f"{name}: the curve's last point")
        near(exact[4], length, 0.3, f"{name}: the curve's length")
        near(exact[3], arc, 0.5, f"{name}: the arc's most posterior point")
        near(math.dist(curve[0], exact[0][0]), 0, 1.5, f"{name}: what is shown is of the point clicked")
        colour = page.value(f"colourOf(pins[{number - 1}])")
        check(page.coloured(f"view-{1 - k}", colour) > 60, f"{name}: its curve is drawn in the other view")
        check(page.coloured("body", colour) > 20, f"{name}: its column is drawn in the body")


def check_marks(page: Page) -> None:
    for canvas in ("view-0", "view-1", "body"):
        for what, colour in (("nipple", "#8ff0a4"), ("tumour", "#ff6b8b")):
            check(page.coloured(canvas, colour) >= 8, f"{what} is seen in {canvas}")
    page.value("document.getElementById('show-marks').click()")
    page.browser.frame()
    check(page.coloured("view-0", "#8ff0a4") == 0, "marks can be switched off")
    page.value("document.getElementById('show-marks').click()")
    page.browser.frame()


def check_undo(page: Page) -> None:
    kept = page.pins()
    page.value("document.getElementById('undo').click()")
    check(page.pins() == kept - 1, "Undo takes the last point back")
    page.value("document.getElementById('clear').click()")
    check(page.pins() == 0, "Clear removes all")
    page.browser.key("z", CONTROL)
    check(page.pins() == kept - 1, "Ctrl Z brings them back")
    page.value("document.querySelector('#pins li:first-child button:last-child').click()")
    check(page.pins() == kept - 2, "one point can be removed")


def check_mouse(page: Page) -> None:
    browser, (x, y) = page.browser, map(round, page.screen(0, 30, 50))
    before = page.value(f"views[0].toImage(...views[0].place({{clientX: {x}, clientY: {y}}}))")
    browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-400)
    browser.frame()
    near(page.value("views[0].zoom"), math.e, 0.01, "zoom by the wheel")
    after = page.value(f"views[0].toImage(...views[0].place({{clientX: {x}, clientY: {y}}}))")
    near(math.dist(before, after), 0, 0.1, "the wheel leaves the spot under the pointer where it is, mm")
    place, kept = page.value("[views[0].x, views[0].y]"), page.pins()
    browser.drag((x, y), (x - 30, y - 20))
    moved = page.value("[views[0].x, views[0].y]")
    near(math.dist(place, moved), math.hypot(30, 20), 2, "a drag moves the image as far, px")
    check(page.pins() == kept, "a drag keeps no point")
    grey = page.mean_grey("view-0")
    browser.drag((x, y), (x + 10, y + 60), "right")
    check(page.value("views[0].window.level") < 0.4, "the right button changes the level")
    check(page.mean_grey("view-0") > grey + 5, "a lower level is a brighter image")
    page.value("document.getElementById('fit').click()")
    browser.frame()
    check(page.value("views[0].zoom === 1 && views[0].window.level === 0.5"), "Reset brings the image back")


def check_keys(page: Page) -> None:
    browser = page.browser
    page.value("clearPins(), document.getElementById('show-marks').focus()")
    browser.key("Tab")
    check(page.value("document.activeElement.id") == "view-0", "Tab goes from the tools to the first view")
    check(page.value("getComputedStyle(document.activeElement).outlineStyle") == "solid", "the focus is seen")
    browser.key("ArrowLeft")
    start = page.value("views[0].cursor")
    browser.key("ArrowLeft")
    browser.key("ArrowDown")
    near(math.dist(start, page.value("views[0].cursor")), math.sqrt(2), 1e-6, "two arrows move the cross by 1 mm each")
    browser.key("Enter")
    check(page.pins() == 1, "Enter keeps the point")
    browser.key("+")
    near(page.value("views[0].zoom"), 1.25, 1e-6, "+ zooms")
    browser.key("[")
    check(page.value("views[0].window.width") < 1, "[ narrows the window")
    along = page.value("along")
    browser.key("PageDown")
    check(page.value("along") > along, "PageDown goes along the column")
    browser.key("0")
    check(page.value("views[0].zoom") == 1, "0 resets")
    browser.key("Tab")
    check(page.value("document.activeElement.id") == "view-1", "Tab goes on to the second view")
    browser.key("Enter")
    check(page.pins() == 2, "Enter keeps a point of the second view")
    browser.key("u")
    check(page.pins() == 1, "U undoes")


def check_slice(page: Page) -> None:
    """The slice beside the point holds the chosen place of the column, and the slider moves both."""
    page.value("hover = null, choose(pins[0])")
    for along in (0.2, 0.8):
        page.value(f"(() => {{ const s = document.getElementById('depth'); s.value = {100 * along};"
                   " s.dispatchEvent(new Event('input')); })()")
        page.browser.frame()
        z, place = page.value("[data.scan.origin[2] + slice.at * data.scan.spacing[2], at(chosen.match.column)[2]]")
        near(z, place, page.value("data.scan.spacing[2]") / 2 + 1e-6, f"slice at {along} of the column, mm")
        check(page.coloured("slice", page.value("colourOf(chosen)")) > 8, "the column is marked in the slice")
    grey = page.mean_grey("slice")
    check(grey > 20, "the slice shows the scan")
    x, y = page.value("(() => { const b = slice.canvas.getBoundingClientRect(); return [b.left + 90, b.top + 90]; })()")
    page.browser.drag((x, y), (x, y + 60))
    check(page.mean_grey("slice") > grey + 5, "a drag on the slice changes its level")
    number = page.value("slice.at")
    page.browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-100)
    page.browser.frame()
    check(page.value("slice.at") == number + 1, "the wheel on the slice turns to the next one")
    # Seen from above, and only from above, the nipple is below the wall on the screen and the patient's left at the right.
    page.value("document.getElementById('above').click()")
    near(page.value("body.turned(0, 0, 1)[2]"), -1, 1e-9, "from above, what is superior is near")
    near(page.value("body.turned(1, 0, 0)[0]"), 1, 1e-9, "and the patient's left at the right")
    near(page.value("body.turned(0, -1, 0)[1]"), 1, 1e-9, "and the nipple's side at the bottom")
    page.value("document.getElementById('side').click()")
    near(page.value("body.turned(left ? 1 : -1, 0, 0)[2]"), -1, 1e-9, "from the side, what is lateral is near")
    page.value("document.getElementById('front').click()")
    near(page.value("body.turned(0, -1, 0)[2]"), -1, 1e-9, "from the front, the nipple is near")
    turn = page.value("body.turn.yaw")
    x, y = page.value("(() => { const b = body.canvas.getBoundingClientRect(); return [b.left + 90, b.top + 90]; })()")
    page.browser.drag((x, y), (x + 60, y))
    near(page.value("body.turn.yaw") - turn, 0.5, 0.05, "a drag turns the body, radians")


def check_layout(page: Page, width: int) -> None:
    check(page.value("document.documentElement.scrollWidth") <= width, f"no sideways scrolling at {width} px")
    low = page.value("Math.max(...views.map(v => v.canvas.getBoundingClientRect().bottom)) - innerHeight")
    check(low <= 0, f"both views are on the screen at {width} px")
    page.value("scrollTo(0, document.documentElement.scrollHeight)")
    page.browser.frame()
    check(page.value("(() => { const b = document.getElementById('research').getBoundingClientRect();"
                     " return b.top >= 0 && b.bottom <= innerHeight && b.height > 10; })()"),
          f"'research only' is seen after scrolling to the end at {width} px")
    page.to_pointing()
    check(page.value("document.getElementById('band-legend').hidden === document.getElementById('show-band').closest('label').hidden"),
          "the box for the band is there with the band")
    unnamed = page.value("[...document.querySelectorAll('button, canvas, input')].filter(e => !(e.getAttribute('aria-label') ||"
                         " e.textContent.trim() || (e.labels && e.labels.length))).map(e => e.id)")
    check(unnamed == [], f"every control has a name: {unnamed}")


def check_pictures(page: Page, width: int) -> None:
    """The pictures that need no script: one scale, bars of 20 mm, inside the page."""
    page.value("scrollTo(0, 0)")
    bars = page.value("[...document.querySelectorAll('svg .bar')].map(bar => { const svg = bar.closest('svg'), box = svg.getBoundingClientRect();"
                      " return [bar.getBoundingClientRect().width, box.width / svg.viewBox.baseVal.width, Number(bar.dataset.mm), box.right]; })")
    check(len(bars) >= 2, f"both views have a bar at {width} px")
    for pixels, scale, mm, right in bars:
        near(pixels / scale, mm, 0.1, f"length of a bar at {width} px, mm")
        near(scale, bars[0][1], 0.01 * scale, f"scale of a picture at {width} px, px/mm")
        check(mm == 20 and right <= width, f"bars say 20 mm and pictures lie in the page at {width} px")
    scale, live = page.value("[new Set(views.map(view => view.scale)).size, views[0].scale > 0]")
    check(scale == 1 and live, f"both views to point at have one scale at {width} px")
    page.to_pointing()


def check_accessibility(page: Page) -> None:
    """Of the rules of WCAG 2.1 those that a program can judge here: names, language, order of headings, and contrast of text."""
    check(page.value("document.documentElement.lang === 'en' && document.title.length > 5"), "language and title")
    check(page.value("[...document.querySelectorAll('img, svg[role=img]')].every(e => (e.alt || e.getAttribute('aria-label') || '').length > 20)"),
          "every picture says what it shows")
    check(page.value("[...document.querySelectorAll('svg:not([role=img])')].every(e => e.getAttribute('aria-hidden') === 'true')"),
          "signs are left out for those who hear the page")
    levels = page.value("[...document.querySelectorAll('h1, h2, h3')].map(e => Number(e.tagName[1]))")
    check(levels[0] == 1 and levels.count(1) == 1 and all(b - a <= 1 for a, b in zip(levels, levels[1:])), f"headings in order: {levels}")
    check(page.value("[...document.querySelectorAll('tr')].every(r => r.querySelector('th[scope=row]'))"), "rows have headers")
    check(page.value("document.querySelectorAll('main').length === 1 && document.querySelectorAll('header').length === 1"), "landmarks")
    pale = page.value("""(() => {
      const rgb = text => text.match(/[\\d.]+/g).map(Number), clear = c => c.length > 3 && c[3] === 0;
      const light = c => c.slice(0, 3).map(v => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
          .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
      const ground = e => {
        for (; e; e = e.parentElement) { const c = rgb(getComputedStyle(e).backgroundColor); if (!clear(c)) return c; }
        return [255, 255, 255];
      };
      const faint = e => {
        const [a, b] = [light(rgb(getComputedStyle(e).color)), light(ground(e))].sort((x, y) => y - x);
        return (a + 0.05) / (b + 0.05) < 4.5;
      };
      return [...document.querySelectorAll('h1, h2, p, li, td, th, small, caption, summary, figcaption, label, button:not(:disabled)')]
          .filter(e => e.textContent.trim() && faint(e))
          .map(e => e.tagName + ' ' + e.textContent.trim().slice(0, 30));
    })()""")
    check(pale == [], f"text stands out from its ground by 4.5 to 1: {pale}")


def check_without_scripts(page: Page) -> None:
    """The sentences, pictures and numbers are there without any script."""
    page.browser.call("Emulation.setScriptExecutionDisabled", value=True)
    page.browser.go("about:blank")
    page.browser.go(page.address)
    seen = page.browser.call("DOMSnapshot.captureSnapshot", computedStyles=[])["strings"]
    for said in ("Where to look", "Clock position", "In numbers", "This part needs scripts, which this browser does not run."):
        check(any(said in text for text in seen), f"without scripts the page says '{said}'")
    page.browser.call("Emulation.setScriptExecutionDisabled", value=False)


def check_touch(page: Page, truth: list[list[str]]) -> None:
    browser, (view, u, v, *_) = page.browser, truth[0]
    k = page.index(view)
    x, y = page.screen(k, float(u), float(v))
    browser.touch("touchStart", (x, y))
    browser.touch("touchEnd")
    browser.frame()
    check(page.pins() == 1, "a tap keeps a point")
    browser.touch("touchStart", (x - 20, y), (x + 20, y))
    for gap in (30, 45, 60):
        browser.touch("touchMove", (x - gap, y), (x + gap, y))
    browser.touch("touchEnd")
    browser.frame()
    near(page.value(f"views[{k}].zoom"), 3, 0.2, "two fingers three times as far apart zoom by three")
    check(page.pins() == 1, "two fingers keep no point")
    page.value("document.getElementById('mode').click()")
    browser.frame()
    browser.touch("touchStart", (x, y))
    for step in (20, 40, 60):
        browser.touch("touchMove", (x, y - step))
    browser.touch("touchEnd")
    check(page.value(f"views[{k}].window.level") > 0.6, "with Window on one finger changes the level")
    check(page.pins() == 1, "and keeps no point")


def run(folder: pathlib.Path, browser: Browser, pictures: pathlib.Path | None) -> None:
    truth = [line.split() for line in (folder / "truth.txt").read_text().splitlines()]
    page = Page(browser, folder / "page.html")
    page.open(1400, 900)
    check_layout(page, 1400)
    check_pictures(page, 1400)
    check_accessibility(page)
    check_marks(page)
    check_against_matcher(page, truth)
    check_slice(page)
    if pictures:
        browser.picture(str(pictures / "page-1400.png"))
    check_undo(page)
    check_mouse(page)
    check_keys(page)
    times = page.value("Array.from({length: 21}, (_, i) => { const t = performance.now(); hoverAt(views[0], 100 + i, 200);"
                       " drawAll(); return performance.now() - t; }).sort((a, b) => a - b)")
    print(f"pointing to drawn: median {times[10]:.1f} ms; first picture after "
          f"{page.value('performance.getEntriesByName(`first picture`)[0].startTime'):.0f} ms; "
          f"{(folder / 'page.html').stat().st_size / 1e6:.1f} MB")
    page.open(420, 900, touch=True)
    check_layout(page, 420)
    check_pictures(page, 420)
    check_touch(page, truth)
    if pictures:
        browser.picture(str(pictures / "page-420.png"), whole=True)
    view, u, v, *_ = truth[1]
    without = Page(browser, folder / "without.html")
    without.open(1400, 900, points=f"{view}:{u},{v}")
    check(without.pins() == 1 and without.value("pins[0].k") == without.index(view), "a link keeps the point it names")
    check(without.value("document.getElementById('slice').getBoundingClientRect().width") == 0, "no scan, no slice")
    check_without_scripts(page)
    check(browser.errors == [], f"the page raises no error: {browser.errors}")
    strange = [r for r in browser.requests if not r.startswith(("file:", "about:", "data:"))]
    check(strange == [], f"the page asks the network for nothing: {strange}")


def main() -> int:
    program = chromium()
    if program is None:
        print("check_page.py: no Chromium; apt-get install chromium", file=sys.stderr)
        return 2
    browser = Browser(program)
    try:
        run(pathlib.Path(sys.argv[1]), browser, pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None)
    finally:
        browser.close()
    print(f"{len(failures)} of the page's properties fail" if failures else "passed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
