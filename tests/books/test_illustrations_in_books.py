"""Figures in the pages of a book: what an author writes, and what becomes of it."""

import json
import re

import pytest
from PIL import Image
from writers import Book

from reactive4d_apps.books.builds import Build

POLE = """# A pole

```{illustration} poles:Pole
:name: pole
:parameters: height=[0.5, 1, 2]

As high as {number}`height:.1f`.
```
"""


def test_a_figure_stands_in_the_page_with_its_caption_its_number_and_its_picture(book: Book):
    """Without a script the picture remains, with a text that says what is to be seen."""
    build = book.build(f"{POLE}\nSee {{numref}}`pole`, and {{word}}`the flag <flag>`.\n", strict=True)
    assert build.ok, build.complaints
    assert (build.figures, build.complaints) == (1, ())
    html = book.html()
    assert re.search(r'<r4d-figure name="pole" title="Pole" data-source="_static/r4d/[0-9a-f]{32}.js"', html)
    alt = re.search(r'<img src="(_static/r4d/[^"]+)" width="1280" height="800" alt="([^"]+)"', html)
    assert alt is not None
    assert "a gold sphere (flag) at (0.00, 0.00, 1.00)" in alt[2]
    assert (build.site / alt[1]).read_bytes()[8:12] == b"WEBP"
    dark = re.search(r'<source media="screen and \(prefers-color-scheme: dark\)" srcset="([^"]+)"', html)
    assert dark is not None
    corners = [Image.open(build.site / path).convert("RGB").getpixel((0, 0)) for path in (alt[1], dark[1])]
    assert [max(corner) > 128 for corner in corners] == [True, False]
    assert '<span class="caption-number">Figure 1 </span>' in html
    assert '<r4d-number figure="pole" name="height" format=".1f">1.0\u202fm</r4d-number>' in html
    assert '<r4d-word figure="pole" node="flag">the flag</r4d-word>' in html
    assert 'href="#pole"' in html


def test_words_for_a_live_figure_wait_behind_those_of_the_page(book: Book):
    """In HTML both are there and the page's stand; elsewhere only these are. Either may be missing."""
    text = f"{POLE}\nOn {{live}}`here <paper>`. {{live}}`Ask & see.` {{live}}`<Still.>`\n"
    assert book.build(text, strict=True).ok
    html = book.html()
    assert '<r4d-either figure="pole" live="here">paper</r4d-either>' in html
    assert '<r4d-either figure="pole" live="Ask &amp; see."></r4d-either>' in html
    assert '<r4d-either figure="pole" live="">Still.</r4d-either>' in html
    build = book.build(builder="latex", strict=True)
    [source] = build.site.glob("*.tex")
    assert re.search(r"On paper\.\s+Still\.", source.read_text(encoding="utf-8"))


def test_a_site_carries_one_viewer_and_asks_for_nothing_elsewhere(book: Book):
    """One classic script for the whole site; formulas are MathML."""
    build = book.build(f"{POLE}\nIt is $h^2$ high.\n\n$$ h = 1 $$\n", strict=True)
    assert build.ok, build.complaints
    html = book.html()
    assert len(re.findall(r'<script[^>]* src="_static/r4d-[0-9a-f]{16}\.js', html)) == 1
    assert len(list((build.site / "_static").glob("r4d-*.js"))) == 1
    assert 'type="module"' not in html
    assert html.count("<math") == 2
    assert "mathjax.js" not in html.lower()
    assert re.findall(r'(?:src|href)="(?:https?:)?//[^"]*"', html) == []


def test_a_page_without_figures_carries_no_viewer(book: Book):
    """Plain text is plain."""
    book.build("# Words\n\nNothing else.\n", strict=True)
    assert "r4d-" not in book.html().replace("r4d-page", "")


def test_a_figure_is_asked_again_only_when_its_program_or_its_parameters_change(book: Book):
    """Another text around it and another width cost nothing; another colour in its module does."""
    book.build(POLE, strict=True)
    first = book.kept()
    assert len(first) == 1
    book.build(POLE.replace("As high as", "So high:").replace(":name:", ":size: full\n:name:"), strict=True)
    assert book.kept() == first
    program = book.folder / "poles.py"
    program.write_text(program.read_text(encoding="utf-8").replace("gold", "tomato"), encoding="utf-8")
    build = book.build(strict=True)
    assert len(book.kept()) == 2, "the page was not written again, and yet its figure is another one"
    assert "orange" in book.html() or "tomato" in book.html() or "red" in book.html()
    book.build(POLE.replace("[0.5, 1, 2]", "[0.5, 2]"), strict=True)
    assert len(book.kept()) == 3
    assert len([path for path in book.data() if "manifest" in path.read_text(encoding="utf-8")]) == 1, build


def test_figures_that_differ_only_in_where_they_open_share_their_data(book: Book):
    """The second one is asked for nothing."""
    twin = POLE.replace("# A pole", "").replace(":name: pole", ":name: twin\n:point: height=2&t=0.5")
    book.build(POLE + twin + "{value}`twin.top:.1f` and {value}`pole.top:.1f`\n", strict=True)
    sources = re.findall(r'data-source="([^"]+)"', book.html())
    assert len(sources) == 2
    assert len(set(sources)) == 1
    assert len(book.kept()) == 1
    assert re.search(r'name="twin"[^>]* point="height=2&amp;t=0.5"', book.html())
    assert ">2.0\u202f</r4d-number>" in book.html() or ">2.0</r4d-number>" in book.html()


def test_a_figure_that_follows_opens_where_its_leader_does(book: Book):
    """They share time and parameters from the beginning."""
    twin = POLE.replace("# A pole", "").replace(":name: pole", ":name: twin\n:follow: pole\n:point: height=2")
    book.build(POLE + twin, strict=True)
    assert re.search(r'name="twin" title="Pole" follow="pole" point="t=0&amp;height=1', book.html())


def test_a_program_in_the_page_is_shown_and_run(book: Book):
    """The last line is what is shown; another program goes on from it."""
    build = book.build(
        """# Balls

```{illustration}
:name: ball
:caption: One *ball*.

ball = r4.Sphere(radius=0.5, color="navy")
r4.Scene(ball=ball)
```

```{illustration}
:name: two
:after: ball
:code: none

both = r4.Scene(ball=ball, box=r4.Box(color="gold"))
```

{word}`box` and {word}`ball.ball`
""",
        strict=True,
    )
    assert build.ok, build.complaints
    html = book.html()
    assert html.count("<r4d-figure") == 2
    assert "One <em>ball</em>." in html
    assert html.count('class="highlight-python') == 1
    assert '<r4d-word figure="two" node="box">box</r4d-word>' in html
    assert '<r4d-word figure="ball" node="ball">ball</r4d-word>' in html


def test_a_script_is_a_figure_and_its_text_stands_beside_it(book: Book):
    """The path is relative to the page."""
    (book.folder / "egg.scefo").write_text('object (egg) sphere color="gold";\n', encoding="utf-8")
    build = book.build("# An egg\n\n```{illustration} egg.scefo\n:code: beside\n\nAn egg.\n```\n", strict=True)
    assert build.ok, build.complaints
    assert "r4d-beside" in book.html()
    assert "highlight-scefo" in book.html()


def test_a_script_that_may_be_edited_is_a_text_where_there_is_no_server(book: Book):
    """And says where it may be; so is the scene of an illustration, if a script can say it."""
    (book.folder / "egg.scefo").write_text('object (egg) sphere color="gold"; /* an egg */\n', encoding="utf-8")
    build = book.build("# An egg\n\n```{illustration} egg.scefo\n:editable:\n:name: egg\n```\n", strict=True)
    assert build.ok, build.complaints
    html = book.html()
    assert re.search(r'<r4d-script figure="egg"><div class="highlight-scefo', html)
    assert "a reader can edit this script, in a copy of their own" in html
    assert not book.build(POLE.replace(":name: pole", ":editable:"), strict=True).ok


def test_an_exercise_says_whether_it_is_done(book: Book):
    """And keeps its solution folded."""
    box = "\n````{exercise} *Taller*\n:check: tall\n\nMake it taller.\n\n:::{solution}\nTwo metres.\n:::\n````\n"
    build = book.build(POLE + box, strict=True)
    assert build.ok, build.complaints
    html = book.html()
    assert "Exercise 1. <em>Taller</em>" in html
    assert '<r4d-check figure="pole" name="tall" class="r4d-check"></r4d-check>' in html
    assert '<details class="solution"><summary>Solution</summary>' in html


MISTAKES = [
    ("```{illustration} poles:Poll\n```", 3, "unknown name in poles 'Poll'"),
    ("```{illustration} nowhere:Pole\n```", 3, "there is no module 'nowhere'"),
    ("```{illustration} poles:Pole\n:parameters: width=3\n```", 3, "unknown parameter 'width'"),
    ("```{illustration} poles:Pole\n:parameters: height=[0.5, 9]\n```", 3, "must be at most 2.0"),
    ("```{illustration} poles:Pole\n:parameters: height=len([])\n```", 3, "is no value"),
    ("```{illustration} poles:Pole\n:times: yesterday\n```", 3, "times"),
    ("```{illustration} poles:Pole\n:point: width=3\n```", 3, "unknown parameter 'width'"),
    ("```{illustration} poles:Pole\n:point: paint=crimson\n```", 3, "holds no paint = crimson"),
    ("```{illustration} poles:Pole\n:options: colour=True\n```", 3, "unknown option of a figure 'colour'"),
    ("```{illustration} poles:Pole\n:follow: nobody\n```", 3, "unknown figure to follow 'nobody'"),
    ("```{illustration} poles:Pole\n:width: 3\n```", 4, "width"),
    ("```{illustration} gone.scefo\n```", 3, "gone.scefo"),
    ("```{illustration}\n\nx = 1\nx / 0\n```", 6, "ZeroDivisionError: division by zero"),
    ("```{illustration}\nx = = 1\n```", 4, "SyntaxError"),
    ("```{illustration}\nx = 1\n```", 3, "makes nothing that can be shown"),
    ("```{illustration}\n```", 3, "nothing is to be shown"),
    ("```{illustration} poles:Pole\n```\n\n{number}`hight`", 6, "unknown parameter 'hight'"),
    ("```{illustration} poles:Pole\n```\n\n{number}`height:x`", 6, "a format as in f-strings"),
    ("```{illustration} poles:Pole\n```\n\n{value}`bottom`", 6, "unknown value 'bottom'"),
    ("```{illustration} poles:Pole\n```\n\n{word}`the mast <mast>`", 6, "unknown object 'mast'"),
    ("```{illustration} poles:Pole\n```\n\n{jump}`up <width=2>`", 6, "unknown parameter 'width'"),
    ("```{illustration} poles:Pole\n```\n\n{jump}`up <paint=crimson>`", 6, "the page holds no paint = crimson"),
    ("```{illustration} poles:Pole\n```\n\n{jump}`up`", 6, "is no point"),
    ("{live}`here`", 3, "the page has no figure"),
    ("{number}`height`", 3, "unknown parameter 'height'"),
]


@pytest.fixture(scope="module")
def mistaken(tmp_path_factory: pytest.TempPathFactory) -> tuple[Book, Build]:
    """A book with one mistake on each page."""
    book = Book(tmp_path_factory.mktemp("mistakes") / "book")
    for i, (text, _, _) in enumerate(MISTAKES):
        book.write(f"# Mistake\n\n{text}\n\nThe rest.\n", f"page{i:02}.md")
    return book, book.build("# Mistakes\n\n```{toctree}\n:glob:\n\npage*\n```\n")


@pytest.mark.parametrize("index", range(len(MISTAKES)), ids=[words for _, _, words in MISTAKES])
def test_a_mistake_is_told_once_with_its_file_and_its_line(mistaken: tuple[Book, Build], index: int):
    """And the rest of the book is built."""
    book, build = mistaken
    _, line, words = MISTAKES[index]
    assert build.ok
    told = [one for one in build.complaints if one.startswith(f"page{index:02}.md:")]
    assert len(told) == 1, told
    assert words in told[0]
    assert told[0].startswith(f"page{index:02}.md:{line}: "), told
    assert "The rest." in book.html(f"page{index:02}.html")


def test_what_is_wrong_is_said_again_until_it_is_mended(book: Book):
    """Though the page was not written again; and where warnings are errors the build fails."""
    text = "# One\n\n```{illustration} poles:Pole\n:times: yesterday\n```\n"
    first, again = book.build(text), book.build()
    assert first.complaints == again.complaints
    assert first.complaints
    assert not book.build(strict=True).ok
    assert book.build(text.replace("yesterday", "0, 1"), strict=True).ok


def test_an_error_in_the_model_is_told_and_the_figure_stands(book: Book):
    """As in a baked page."""
    build = book.build("# One\n\n```{illustration}\nball = r4.Sphere(radius=1 - r4.time)\nr4.Scene(ball=ball)\n```\n")
    assert build.ok
    assert any("ball" in one for one in build.complaints)
    assert "<r4d-figure" in book.html()


def test_a_build_that_was_broken_off_is_made_good_by_the_next(book: Book):
    """What was read and not written is written then, though no page was edited."""
    book.build(POLE, strict=True)
    (book.folder / "build" / "doctrees" / "figures-html.json").unlink()
    (book.folder / "build" / "html" / "index.html").write_text("half", encoding="utf-8")
    kept = book.kept()
    book.build(strict=True)
    assert "<r4d-figure" in book.html()
    assert book.kept() == kept


def test_latex_has_the_pictures(book: Book):
    """Numbers, links and words are their texts."""
    build = book.build(f"{POLE}\nGo {{jump}}`up <height=2>`.\n", builder="latex", strict=True)
    assert build.ok, build.complaints
    [source] = build.site.glob("*.tex")
    text = source.read_text(encoding="utf-8")
    pictures = list(build.site.glob("*.png"))
    assert len(pictures) == 1
    assert pictures[0].stem in text
    assert "Go up." in text
    assert "As high as 1.0" in text


def test_large_arrays_have_files_of_their_own_which_figures_share(book: Book):
    """A teapot has the same surface in two figures with other times."""
    pot = "pot = r4.Teapot()\npot.translate(r4.vec(r4.time, 0, 0))\nr4.Scene(pot=pot)"
    figure = "```{{illustration}}\n:times: 0, {0}\n:name: pot{0}\n\n" + pot + "\n```\n"
    book.build("# Two\n\n" + figure.format(1) + "\n" + figure.format(2), strict=True)
    texts = [path.read_text(encoding="utf-8") for path in book.data()]
    found = [json.loads(text.split("=", 1)[1].rstrip(";\n")) for text in texts if "manifest" in text]
    named = [{chunk["file"] for chunk in table["chunks"] if "file" in chunk} for table in found]
    assert len(named) == 2
    assert named[0] & named[1]
    written = {path.name for path in book.data()}
    assert named[0] | named[1] <= written


def test_what_no_figure_says_any_more_is_removed_from_the_site(book: Book):
    """A site does not grow with every build."""
    book.build(POLE, strict=True)
    before = book.data()
    book.build(POLE.replace(":name: pole", ":name: pole\n:times: 0, 3"), strict=True)
    assert len(book.data()) == len(before)
    assert before != book.data()
