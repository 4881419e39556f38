"""The page in a real browser: Debian's Chromium (``CHROMIUM`` names another).

Without it these tests skip, unless ``GRAPHKIN_BROWSER=required``.
"""

from __future__ import annotations

import shutil
import subprocess
from itertools import pairwise

import pytest


@pytest.fixture(scope="module")
def file(shaper, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "handout.html"
    path.write_bytes(shaper.files["handout.html"])
    return path


@pytest.fixture(scope="module")
def tab(browser):
    one = browser.new_page()
    one.said, one.asked = [], []
    one.on("console", lambda message: one.said.append(message.text))
    one.on("pageerror", lambda error: one.said.append(str(error)))
    one.on("request", lambda request: one.asked.append(request.url))
    yield one
    one.close()


@pytest.fixture
def page(tab, file):
    """The page loaded anew; a tab of its own for each test would take the processor twice as long."""
    tab.set_viewport_size({"width": 1400, "height": 900})
    tab.said.clear()
    tab.asked.clear()
    tab.goto(file.as_uri())
    tab.wait_for_selector("html.ready")
    return tab


def _step(page) -> int:
    return int(page.locator("#list button.now").get_attribute("data-step"))


def test_no_request_leaves_the_file_and_nothing_is_complained_of(page, file):
    for key in ("End", "PageUp", "ArrowRight", "Home"):
        page.keyboard.press(key)
    page.locator("#place").fill("2")
    assert [file.as_uri()] == page.asked
    assert [] == page.said


def test_a_script_that_is_not_the_pages_own_does_not_run(page):
    page.evaluate("""() => {
      const script = document.createElement("script");
      script.textContent = "document.title = 'owned'";
      document.body.append(script);
      document.body.insertAdjacentHTML("beforeend", "<img src='x:' onerror=\\"document.title='owned'\\">");
    }""")
    page.wait_for_timeout(100)
    assert "owned" != page.title()


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        (["ArrowRight"], 2),
        (["ArrowRight", "ArrowRight", "ArrowLeft"], 2),
        (["End"], 43),
        (["End", "Home"], 1),
        (["PageDown"], 9),
        (["]", "]"], 10),
        (["]", "]", "["], 9),
        (["PageDown", "PageDown", "PageUp"], 9),
    ],
)
def test_keys_go_through_steps_and_equations(page, keys, expected):
    for key in keys:
        page.keyboard.press(key)
    assert expected == _step(page)


def test_the_slider_goes_to_a_step_and_says_it(page):
    page.locator("#step").fill("13")
    assert 13 == _step(page)
    assert "Step 13 of 43" in page.locator("#step").get_attribute("aria-valuetext")
    assert "56.67 mm" in page.locator("#live").inner_text()


def test_only_what_is_drawn_by_then_is_seen(page):
    page.locator("#step").fill("13")
    assert page.locator("#figures #v_A4").is_visible()
    assert not page.locator("#figures #v_C").is_visible()


def test_arrow_keys_on_the_slider_move_one_step(page):
    page.locator("#step").focus()
    page.keyboard.press("ArrowRight")
    assert 2 == _step(page)


def test_the_second_slider_moves_mechanism_polygons_centres_and_steps(page):
    names = ("mechanism", "velocity", "acceleration", "centres")
    before = [page.locator(f"#figure-{n} svg").inner_html() for n in names]
    words = page.locator("#list").inner_text()
    page.locator("#place").fill("1")
    after = [page.locator(f"#figure-{n} svg").inner_html() for n in names]
    assert all(one != two for one, two in zip(before, after, strict=True))
    assert words != page.locator("#list").inner_text()


def test_the_step_stays_when_the_position_moves(page):
    page.locator("#step").fill("13")
    page.locator("#place").fill("1")
    assert 13 == _step(page)


def test_hovering_a_step_lights_its_vector(page):
    page.keyboard.press("End")
    page.locator("#list button[data-step='13']").hover()
    assert "lit" in page.locator("#v_A4").get_attribute("class")
    assert "lit" not in page.locator("#v_C").get_attribute("class")


def test_hovering_a_vector_lights_its_step(page):
    page.keyboard.press("End")
    page.locator("#v_A .hit line").hover()
    assert "lit" in page.locator("#list button[data-step='9']").get_attribute("class")


def test_a_vector_clicked_is_the_step(page):
    page.keyboard.press("End")
    page.locator("#v_A .hit line").click()
    assert 9 == _step(page)


def test_every_control_is_reached_by_tab_and_has_a_name(page):
    seen = []
    for _ in range(10):
        page.keyboard.press("Tab")
        seen.append(
            page.evaluate("""() => {
          const e = document.activeElement;
          return [e.id || e.dataset.go || e.dataset.step, (e.labels?.[0] ?? e).innerText.trim()];
        }""")
        )
    reached = dict(seen)
    names = ["first", "previous", "next", "last", "equation", "play", "try", "step", "place", "1"]
    assert names == [name for name, _ in seen]
    assert all(reached[name] for name in names)


def test_a_step_in_the_list_is_taken_with_the_keyboard(page):
    page.locator("#list button[data-step='1']").focus()
    for key in ("ArrowDown", "ArrowDown"):
        page.keyboard.press(key)
    assert "3" == page.evaluate("document.activeElement.dataset.step")
    assert 3 == _step(page)


def test_the_step_is_announced(page):
    page.keyboard.press("ArrowRight")
    live = page.locator("[role=status][aria-live=polite]")
    assert "link 2" in live.inner_text()
    assert "step" == page.locator("#list button.now").get_attribute("aria-current")


def test_figures_have_names_for_readers_of_screens(page):
    for figure in page.locator("#figures svg").all():
        assert "img" == figure.get_attribute("role")
        assert figure.get_attribute("aria-label")


def test_printing_gives_the_worked_solution_on_a4(page, tmp_path):
    if not shutil.which("pdfinfo"):
        pytest.skip("pdfinfo is not installed (Debian: poppler-utils)")
    path = tmp_path / "print.pdf"
    page.pdf(path=path, prefer_css_page_size=True)
    facts = subprocess.run(["pdfinfo", str(path)], capture_output=True, check=True).stdout.decode()
    words = subprocess.run(["pdftotext", str(path), "-"], capture_output=True, check=True).stdout.decode()
    assert "(A4)" in facts
    assert "Equation 6: acceleration" in words
    assert "Next step" not in words


def test_without_scripts_the_worked_solution_stands_there(browser, file):
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    tab.goto(file.as_uri())
    assert tab.locator("article.paper ol.steps li").first.is_visible()
    assert not tab.locator("#viewer").is_visible()
    context.close()


def test_nothing_runs_off_a_narrow_screen(page):
    page.set_viewport_size({"width": 360, "height": 800})
    assert 360 >= page.evaluate("document.documentElement.scrollWidth")
    ends = "[...document.querySelectorAll('.controls button')].map((one) => one.getBoundingClientRect().right)"
    assert 360 >= max(page.evaluate(ends))
    assert page.get_by_role("button", name="Next equation").is_visible()


def test_the_space_bar_plays_polygons_centres_and_traces_together(page):
    def places():
        return page.evaluate(
            "[...document.querySelectorAll('#moving .bar, #moving .vector, #moving .centre')].map((e) => e.outerHTML)"
        )

    before = places()
    page.keyboard.press(" ")
    page.wait_for_timeout(500)
    page.keyboard.press(" ")
    after = places()
    assert 3 == page.locator("#moving svg").count()
    assert page.locator("#moving .traces polyline").count()
    assert len(before) / 2 < sum(one != two for one, two in zip(before, after, strict=True))


def test_names_of_what_moves_keep_clear_of_each_other_and_of_the_edge(page):
    page.evaluate("document.getElementById('poles').checked || document.getElementById('poles').click()")
    shown, wrong = page.evaluate("""() => {
      const turn = document.getElementById("turn"), wrong = [];
      let shown = 0;
      for (let k = 0; k <= turn.max; k += 6) {
        turn.value = k;
        turn.dispatchEvent(new Event("input"));
        for (const svg of document.querySelectorAll("#moving svg")) {
          const page = svg.getBoundingClientRect();
          const texts = [...svg.querySelectorAll("text")].filter((text) => text.getClientRects().length);
          shown += texts.length;
          const boxes = texts.map((text) => [text.textContent, text.getBoundingClientRect()]);
          boxes.forEach(([name, a], i) => {
            if (a.left < page.left - 1 || a.right > page.right + 1) wrong.push(name);
            for (const [other, b] of boxes.slice(i + 1)) {  // a third of a line is blank
              const beside = a.left >= b.right - 1 || b.left >= a.right - 1;
              if (!beside && Math.abs(a.top - b.top) < 0.6 * a.height) wrong.push([name, other]);
            }
          });
        }
      }
      return [shown, wrong];
    }""")
    assert shown > 200
    assert [] == wrong


def test_moving_the_driver_moves_results_and_the_printed_page(page):
    def texts():
        return [page.locator(f"#{name}").text_content() for name in ("results", "paper", "given")]

    before = texts()
    page.locator("#place").fill("1")
    assert all(one != two for one, two in zip(before, texts(), strict=True))
    captions = page.locator("#paper figcaption").all_text_contents()
    assert captions
    assert [f"Figure {i}." for i in range(1, len(captions) + 1)] == [" ".join(c.split()[:2]) for c in captions]
    page.locator("#place").fill("0")
    assert before == texts()


def test_try_first_hides_the_step_checks_what_is_entered_and_shows_it_when_right(page):
    page.locator("#step").fill("12")
    page.locator("#try").check()
    page.locator("#step").fill("12")
    page.keyboard.press("ArrowRight")
    page.locator("#trial-size").fill("300")
    page.locator("#trial-way").fill("-13")
    page.get_by_role("button", name="Try", exact=True).click()
    assert ("The size is off.", 12) == (page.locator("#trial-said").inner_text(), _step(page))
    page.locator("#trial-hint").click()
    assert "Equation 2" in page.locator("#trial-said").inner_text()
    page.locator("#trial-size").fill("285,1")
    page.get_by_role("button", name="Try", exact=True).click()
    assert 13 == _step(page)


@pytest.mark.parametrize("width", [360, 1024, 1920])
def test_letters_of_figures_have_12_pixels(page, width):
    page.set_viewport_size({"width": width, "height": 800})
    page.keyboard.press("End")
    page.wait_for_timeout(100)
    sizes = page.evaluate("""() => [...document.querySelectorAll("#figures svg, #moving svg, #list svg")]
      .filter((svg) => svg.getClientRects().length).flatMap((svg) => {
        const matrix = svg.getScreenCTM(), scale = Math.hypot(matrix.a, matrix.b);
        return [...svg.querySelectorAll("text")].filter((t) => t.getClientRects().length)
          .map((t) => scale * parseFloat(t.getAttribute("font-size") ?? getComputedStyle(t).fontSize));
      })""")
    assert len(sizes) > 30
    assert min(sizes) >= 11.99


def test_what_was_drawn_before_keeps_a_contrast_of_four_and_a_half(page):
    page.locator("#step").fill("37")
    worst = page.evaluate("""() => {
      const linear = (c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
      const contrast = (colour) => {
        const [r, g, b] = colour.match(/[0-9.]+/g).map((v) => v / 255);
        return 1.05 / (linear(0.2126 * r + 0.7152 * g + 0.0722 * b) + 0.05);  // grey, as the page shows it
      };
      const past = [...document.querySelectorAll("#figures .past")];
      const seen = past.flatMap((e) => [e, ...e.querySelectorAll("*")]).filter((e) => !e.closest(".hit, .halo"));
      const texts = seen.filter((e) => e.matches("text")).map((e) => getComputedStyle(e));
      const lines = seen.filter((e) => e.matches("line, polyline")).map((e) => getComputedStyle(e));
      const clear = [...texts, ...lines].filter((s) => Number(s.opacity) < 1 || Number(s.fillOpacity) < 1);
      return [texts.length, lines.length, clear.length,
        Math.min(...texts.map((s) => contrast(s.fill)), ...lines.map((s) => contrast(s.stroke)))];
    }""")
    assert worst[0] > 10
    assert worst[1] > 10
    assert 0 == worst[2]
    assert worst[3] >= 4.5


def test_symbols_are_read_aloud_in_words(page):
    page.locator("#step").fill("13")
    said = page.locator("#live .sym[role=math]").evaluate_all("all => all.map((e) => e.ariaLabel)")
    assert "velocity of A4" in said
    assert "velocity of A4 relative to A3" in page.locator("#results .sym").evaluate_all(
        "all => all.map((e) => e.ariaLabel)"
    )


def test_each_figure_is_described_as_it_stands_at_the_position_shown(page):
    def told():
        return page.locator("#figure-velocity svg").get_attribute("aria-label")

    first = told()
    assert "velocity of A4 relative to A3 532.5 mm/s, 76.9°" in first
    page.locator("#place").fill("1")
    at = page.locator("#place-out").inner_text().split("°")[0].split("=")[-1].strip()
    assert at in told()
    assert first != told()


def test_headings_follow_their_order_and_tables_take_the_focus(page):
    levels = page.evaluate("""() => [...document.querySelectorAll("h1, h2, h3, h4")]
      .filter((e) => e.getClientRects().length).map((e) => Number(e.tagName[1]))""")
    assert 1 == levels[0]
    assert all(after - before <= 1 for before, after in pairwise(levels))
    assert page.locator("#results .wide[tabindex='0'] table").count()
