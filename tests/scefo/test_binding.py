"""Scripts as scenes: what statements do, what is kept, what is refused and where."""

import re
from importlib.resources import files as resources
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

import reactive4d as r4
from reactive4d.errors import UnknownNameError
from reactive4d.geometry import files
from reactive4d.model.registries import KINDS

HERE = Path(__file__).parent
CORPUS = sorted((HERE / "corpus").glob("*.scefo"))
PAGE = (HERE.parents[1] / "docs" / "scefo.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"```scefo\n(.*?)```", PAGE, re.DOTALL)


@pytest.fixture(name="folder")
def models(tmp_path: Path) -> Path:
    """A folder with the files that the examples read."""
    for name in ("sphere", "cube", "light", "camera"):
        files.dump(r4.Box().mesh.at(0.0), tmp_path / f"{name}.off")
    return tmp_path


# -- reading and writing -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", CORPUS, ids=lambda path: path.stem)
def test_scripts_of_before_are_read_and_written_as_they_stand(path: Path) -> None:
    """F086: text, scene, text: nothing is lost, not even a comment, or a kind that is not known here."""
    text = path.read_text(encoding="utf-8")
    scene = r4.loads(text, file=str(path))

    assert r4.dumps(scene) == text
    assert scene.at(1.0) is not None


@pytest.mark.parametrize("text", EXAMPLES)
def test_the_examples_of_the_page_are_scenes(text: str, folder: Path) -> None:
    """Each of them is read, asked, and written so that it is read again."""
    scene = r4.loads(text, folder=folder)
    frame = scene.at(1.0)

    again = r4.loads(r4.dumps(scene), folder=folder)
    assert [node.matrix.tobytes() for node in again.at(1.0).values()] == [n.matrix.tobytes() for n in frame.values()]
    assert list(again) == list(scene)


def test_statements_are_the_history() -> None:
    """F009, F011: of two changes the one that stands first acts first, whichever objects they are for."""
    text = """
        object (rivet) cylinder;
        template (left) rivet;
        change (left) translate {1, 0, 0};
        change (rivet) {order} 2;
    """
    scene = r4.loads(text.replace("{order}", "scale"))
    np.testing.assert_array_equal(scene["left"].position.at(0.0), (2, 0, 0))

    swapped = text.replace("change (left) translate {1, 0, 0};", "").replace(
        "{order} 2;", "scale 2; change (left) translate {1, 0, 0};"
    )
    np.testing.assert_array_equal(r4.loads(swapped)["left"].position.at(0.0), (1, 0, 0))


def test_values_over_time_and_over_the_scene() -> None:
    """F087: numbers, strings, objects, functions, lists of lists, the second of a list, a value of another object."""
    scene = r4.loads("""
        object (head) sphere radius = 3.1416;
        change (head) translate {0, 0, 2 * time};
        hidden object (camera) camera;
        object (robot) group members = {head: head, eye: camera};
        signal (sizes) {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
        object (crate) box size = item(sizes, 2);
        object (bird) cone radius = abs(sin(3 * time));
        change (bird) translate robot.head.position + {0, 0, 1}, look_at robot.eye.target;
        object (note) label text = "up";
    """)
    np.testing.assert_array_equal(scene["crate"].size.at(0.0), (4, 5, 6))
    np.testing.assert_array_equal(scene["bird"].position.at(1.0), (0, 0, 3))
    assert scene["bird"].radius.at(1.0) == abs(np.sin(3.0))
    assert scene["robot"].members.at(0.0)[1][1].kind.at(0.0) is r4.Camera


def test_settings_are_told_by_their_names() -> None:
    """F072: set_parameter sets what a kind knows, and keeps what no kind knows."""
    scene = r4.loads("""
        object (lamp) light;
        change (lamp)
            set_parameter <0, {"light_type", "point"}>, <2, {"light_type", "spot"}>,
            set_parameter {"wattage", 60},
            set_parameter intensity = 2;
    """)
    lamp = scene["lamp"]
    assert (lamp.parameters["light_type"].at(1.0), lamp.parameters["light_type"].at(2.0)) == ("point", "spot")
    assert lamp.parameters["wattage"].at(0.0) == 60
    assert lamp.parameters["intensity"].at(0.0) == 2.0
    assert lamp.changes.entries == ()


def test_prototypes_and_kinds_are_changes_too() -> None:
    """F078: an object gets its kind, and its prototype, by a change of it."""
    scene = r4.loads("""
        object (thing) object;
        object (ball) sphere radius = 2;
        change (thing) template ball, translate {1, 0, 0};
        change (ball) chrep <0, "sphere">, <2, "cone">, chrep "box" enabled = <0, false>, <4, true>;
    """)
    assert [scene["thing"].kind.at(t).script for t in (0.0, 2.0, 4.0)] == ["sphere", "cone", "box"]
    assert scene["thing"].volume.at(0.0) == pytest.approx(4 / 3 * np.pi * 8)


# -- comments ----------------------------------------------------------------------------------------------------------

COMMENTED = """\
/* a scene */

object (ball) sphere
    radius = 2 * 0.5 // of one metre
    color = "crimson"; // and red
variable (speed) 1 / 3; /* set by a program */

// it moves
change (ball)
    /* at first */
    translate
        <0, {0, 0, 0}>, // here
        <2, {4 / 2, 0, 0}>, // there
    rotate 3 * speed; // slowly
object (other) box;
// the end
"""


def test_comments_and_words_are_kept() -> None:
    """What was not edited stands as it stood: comments beside what they belong to, sums that were not worked out."""
    text = r4.dumps(r4.loads(COMMENTED))

    assert [line.strip() for line in text.split("\n")] == [line.strip() for line in COMMENTED.split("\n")]
    assert r4.dumps(r4.loads(text)) == text


def test_comments_outlast_edits() -> None:
    """What is edited is written anew with its comments; what is removed takes its own along."""
    scene = r4.loads(COMMENTED)
    scene["ball"].radius = 3
    scene["ball"].changes[0].offset.source.points[2] = (5, 0, 0)
    scene["ball"].translate((0, 0, 1))
    del scene["other"]
    text = r4.dumps(scene)

    assert text.replace("    ", "") == (
        COMMENTED.replace("    ", "")
        .replace("2 * 0.5", "3")
        .replace("{4 / 2, 0, 0}", "{5, 0, 0}")
        .replace("object (other) box;\n", "change (ball) translate {0, 0, 1};\n")
    )


def test_names_that_the_script_alone_knows_are_kept() -> None:
    """Of hidden objects, changes and signals: they have none in the scene, but the script is not renamed."""
    text = """\
hidden object (_left) box; // hidden
change () _hop: translate {0, 0, 1}; // for later
signal (_half) 0.5 * time;
template (right) _left;
change (right) rotate _half, scale _half, use _hop;
template (other) _left;
change (other) look_at _hop.offset;
"""
    scene = r4.loads(text)
    assert "".join(re.split(r"\s", r4.dumps(scene))) == "".join(re.split(r"\s", text))
    assert not scene["right"].prototype_content.is_named
    assert not scene["right"].changes[2].is_named
    assert scene.signals == {}


# -- files -------------------------------------------------------------------------------------------------------------


def test_scenes_are_saved_and_loaded(folder: Path) -> None:
    """F157: a scene, its files and its relations; saved into another folder above, it finds its files."""
    (folder / "deep").mkdir()
    files.dump(r4.Sphere().mesh.at(0.0), folder / "deep" / "ball.off")
    script = folder / "deep" / "scene.scefo"
    script.write_text('read ("ball.off") ball color = "red"; /* a ball */\n', encoding="utf-8")
    scene = r4.Scene.load(script)
    scene.save(folder / "above.scefo")

    assert (folder / "above.scefo").read_text(encoding="utf-8") == (
        'read ("deep/ball.off") ball color = "red"; /* a ball */\n'
    )
    again = r4.Scene.load(folder / "above.scefo")
    assert again["ball"].mesh.at(0.0) == scene["ball"].mesh.at(0.0)

    class Stage(r4.Scene):
        """Scenes of one's own are loaded as such."""

    assert type(Stage.load(script)) is Stage


def test_a_scene_is_not_saved_where_its_files_are_not_found(folder: Path, tmp_path_factory: Any) -> None:
    """A script reads no file outside of its folder; so it is not written there."""
    scene = r4.loads('read ("cube.off") cube;', folder=folder)
    with pytest.raises(r4.NotWritableError, match=r"cube.off lies outside of"):
        scene.save(tmp_path_factory.mktemp("elsewhere") / "scene.scefo")


@pytest.mark.parametrize(
    ("statement", "message"),
    [
        ('read ("missing.off") x;', "missing.off: there is no such file"),
        ('read ("../secret.off") x;', "lies outside of the folder"),
        ('read ("/etc/passwd.off") x;', "lies outside of the folder"),
        ('read ("cube.exe") x;', "no such file"),
        ('read ("notes.txt") x;', "unknown kind of file"),
        ('read ("a\\x00.off") x;', "cannot be read|no such file"),
        ('object (x) model source_folder = "/";', "cannot choose"),
        ('object (x) box; change (x) set_parameter {"source_folder", "/"};', "cannot choose"),
    ],
)
def test_files_are_read_from_the_folder_alone(statement: str, message: str, folder: Path) -> None:
    """Missing, foreign and strange files are refused when the script is read, with their place."""
    (folder / "inner").mkdir()
    (folder / "secret.off").write_bytes((folder / "cube.off").read_bytes())
    (folder / "inner" / "notes.txt").write_text("no mesh", encoding="utf-8")
    with pytest.raises(r4.ScriptError, match=message) as caught:
        r4.loads(statement, folder=folder / "inner")
    assert caught.value.line == 1


@pytest.mark.parametrize(
    "text",
    [
        'object (x) model source = "../secret.off";',
        'object (x) box source = "../secret.off"; change (x) chrep "model";',
        'object (x) model; change (x) set_parameter <0, {"source", "../secret.off"}>;',
        'object (a) model source = "cube.off"; template (x) a source = where(time < 1, "../secret.off", "cube.off");',
    ],
)
def test_no_other_way_leads_out_of_the_folder(text: str, folder: Path) -> None:
    """However a source is told, nothing outside is read when the surface is asked for."""
    (folder / "inner").mkdir()
    (folder / "secret.off").write_bytes((folder / "cube.off").read_bytes())
    (folder / "inner" / "cube.off").write_bytes((folder / "cube.off").read_bytes())
    scene = r4.loads(text, folder=folder / "inner")
    with pytest.raises(r4.Reactive4dError, match="lies outside of the folder"):
        scene["x"].mesh.at(0.0)


def test_only_scripts_are_scenes(tmp_path: Path) -> None:
    """The end of the name tells the format."""
    with pytest.raises(UnknownNameError, match=r"unknown format of scenes '.txt'"):
        r4.Scene().save(tmp_path / "scene.txt")
    with pytest.raises(FileNotFoundError):
        r4.Scene.load(tmp_path / "scene.scefo")
    with pytest.raises(OSError, match="No such file"):
        r4.Scene().save(tmp_path / "no" / "folder.scefo")


# -- strangers ---------------------------------------------------------------------------------------------------------


def test_what_is_not_known_here_is_kept() -> None:
    """A kind and a change of somebody's own do nothing, keep their values, and are written again."""
    text = """\
object (gear) acme.gear teeth = 12 shape = {{0, 1}, "involute", time};
change (gear)
    own.tremble <0, 1>, <2, 3> values = {1, 2} lane = "fast" enabled = <0, true>, <1, false>,
    translate {1, 0, 0};
template (other) gear teeth = 13;
object (ball) sphere;
change (ball) late: chrep "acme.gear" enabled = (time > 2);
signal (speed) late.enabled;
"""
    scene = r4.loads(text)
    gear = scene["gear"]

    assert r4.dumps(scene) == text
    scene.remembered = None
    assert r4.dumps(r4.loads(r4.dumps(scene))) == r4.dumps(scene)
    np.testing.assert_array_equal(scene["other"].position.at(0.0), (1, 0, 0))
    assert scene["other"].parameters["teeth"].at(0.0) == 13
    assert gear.notes.at(0.0) == (("own.tremble", {"value": 1.0, "values": (1, 2), "lane": "fast"}),)
    assert gear.notes.at(1.5) == ()
    assert scene.at(0.0)["gear"].kind == "acme.gear"
    with pytest.raises(r4.Reactive4dError, match=r"kind 'acme\.gear' that is not known here has no faces"):
        gear.mesh.at(0.0)
    assert scene["ball"].volume.at(0.0) > 0
    assert "acme.gear" not in KINDS


def test_a_stranger_becomes_known_where_it_is_defined() -> None:
    """The script that kept it finds the class once there is one."""
    text = 'object (w) own.windmill sails = 4;\nchange (w) chrep "own.windmill";\n'
    assert not hasattr(type(r4.loads(text)["w"]), "sails")
    before = dict(KINDS)

    class Windmill(r4.Object):
        """A kind of one's own, defined in the meantime."""

        sails = r4.Integer(3)

    try:
        scene = r4.loads(text)
        assert type(scene["w"]) is Windmill
        assert scene["w"].parameters["sails"].at(0.0) == 4
        assert scene["w"].kind.at(0.0) is Windmill
        assert r4.dumps(scene) == text
        assert type(r4.loads("object (w) windmill;")["w"]) is Windmill
    finally:
        KINDS.clear()
        KINDS.update(before)


# -- what is refused ---------------------------------------------------------------------------------------------------

WRONG: dict[str, tuple[int, int, str]] = {
    "object (a) spere;": (1, 12, "unknown kind 'spere'"),
    "object (a) sphere radus = 2;": (1, 19, "no kind has a setting 'radus'"),
    "object (a) sphere radius = 2 radius = 3;": (1, 30, "'radius' is given twice"),
    'object (a) sphere radius = "big";': (1, 28, "Sphere.radius: expected a number"),
    "object (a) sphere radius = -1;": (1, 28, "Sphere.radius: expected a number of at least 0"),
    "object (a) sphere radius = <0, 1>, <2, {1, 2}>;": (1, 28, "several kinds"),
    'object (a) sphere color = <0, "red">, <2, {1, 2}> as held;': (1, 43, "Sphere.color|Object.color"),
    'object (a) light light_type = <0, "point">, <1, "sport">;': (1, 49, "unknown Light.light_type 'sport'"),
    "object (a) box size = {1, 2};": (1, 23, "expected 3 numbers or one"),
    "object (a) box size = {1, 2, x};": (1, 30, "nothing is called 'x'"),
    "object (a) box; object (a) sphere;": (1, 25, "the name 'a' is given twice, here and at 1:9"),
    "signal (a) 1; object (a) sphere;": (1, 23, "given twice"),
    "change (a) scale 2; object (a) box;": (1, 9, "'a' is defined only later, at 1:29"),
    "object (a) box;\nchange (a) bend knee.angle, knee: twist 3;": (2, 17, "'knee' is defined only later, at 2:29"),
    "object (a) box; change (a) use knee;": (1, 32, "nothing is called 'knee'"),
    "object (a) box; change (a) use a;": (1, 32, "a is an object, expected a change"),
    "signal (s) 2 * time; change (s) scale 2;": (1, 30, "s is a signal, expected an object"),
    "object (a) box; change (a) sclae 2;": (1, 28, "unknown change 'sclae'"),
    "object (a) box; change (a) bend angel = 2;": (1, 33, "bend has no attribute 'angel'"),
    "object (a) box; change (a) bend;": (1, 28, "Bend needs angle"),
    "object (a) box; change (a) bend 3 angle = 4;": (1, 35, "'angle' is given twice"),
    "object (a) box; change (a) xform {1, 0, 0};": (1, 34, "xform takes no value without a name"),
    "object (a) box; change (a) scale enabled = 3;": (1, 28, "Scale needs factor"),
    'object (a) box; change (a) scale 2 enabled = "no";': (1, 46, "expected True or False"),
    "object (a) box; change (a) shade_val {GLOSS, 1};": (1, 39, "there is no shading value 'GLOSS'"),
    "object (a) box; change (a) shade_val 1;": (1, 38, "expected {name, value} for a shading value"),
    "object (a) box; change (a) set_parameter;": (1, 28, "set_parameter needs a value"),
    "change () set_parameter x = 2;": (1, 11, "set_parameter is for objects"),
    "object (a) box; change (a) k: set_parameter size = 2;": (1, 28, "has no name of its own"),
    "object (a) box; change (a, a) scale 2;": (1, 28, "a stands twice"),
    "object (a) box; template (b) a; change (a) template b;": (1, 53, "its own prototype: a -> b -> a"),
    "object (a) box; change (a) template a;": (1, 37, "its own prototype"),
    "template (b) 3;": (1, 14, "expected an object"),
    "object (a) box; template (b) <0, a>, <1, 3>;": (1, 30, "several kinds|expected an object"),
    "signal (s) <0, 1>, <0, 2>;": (1, 20, "a second key at 0.0 s"),
    "signal (s) <0, 1>, <1, 2> by linaer;": (1, 12, "unknown interpolation 'linaer'"),
    "signal (s) sine(time);": (1, 12, "there is no function 'sine'"),
    "signal (s) sin();": (1, 12, "sin takes 1 value, got 0"),
    "signal (s) {1, 2} + {1, 2, 3};": (1, 12, "shapes"),
    "signal (s) <0, nan>;": (1, 16, "nan is no value"),
    "object (a) box; signal (s) a.volum;": (1, 28, "a has nothing called 'volum'"),
    "object (a) box; signal (s) a.size.x;": (1, 28, "a.size is a signal, which has nothing called 'x'"),
    "object (a) box; signal (s) 2 * a;": (1, 28, "unsupported operand"),
    "object (a) box; show (a) a;": (1, 23, "'a' is in the scene by now"),
    "show (b) a;": (1, 10, "nothing is called 'a'"),
    "object (`a/b`) box;": (1, 9, "'a/b' is not a name for an object"),
    "parameter (p) 1.0 bounds = {2, 3};": (1, 15, "bounds|within"),
    "parameter (p) 1.0 step = 3;": (1, 19, "a parameter has no 'step'"),
    "parameter (`a b`) 1.0;": (1, 19, "'a b' is not a name for a parameter"),
    "object (a) csg tree = {a, \"~\", a};": (1, 23, "is no operation"),
    "object (a) group members = {x: 3};": (1, 28, "expected names with objects"),
    "object (a) box; change (a) matrix {{1, 0}, {0, 1}};": (1, 35, r"shape \(4, 4\)"),
    "object (a) box; change (a) twist 3 space = 3;": (1, 44, "expected an object"),
    "object (a) path controls = {{0, 0, 0}};": (1, 28, "expected 2 to"),
    "object (a) box; change (a) linked_xform a.prototype, translate a;": (1, 64, "expected 3 numbers"),
}  # fmt: skip


@pytest.mark.parametrize("text", WRONG)
def test_what_makes_no_sense_is_refused_with_its_place(text: str) -> None:
    """Line and column of what is wrong, the line itself with a caret, and a sentence that says what was expected."""
    line, column, message = WRONG[text]
    with pytest.raises(r4.ScriptError, match=message) as caught:
        r4.loads(text, file="wrong.scefo")

    error = caught.value
    assert (error.file, error.line, error.column) == ("wrong.scefo", line, column), str(error)
    assert error.__notes__[-1].endswith("^")


def test_a_misspelt_name_gets_the_nearest_one() -> None:
    """Kinds, settings, changes, attributes, functions, objects, channels."""
    for text, near in {
        "object (a) spere;": "sphere",
        "object (a) sphere radus = 2;": "radius",
        "object (a) box; change (a) rotat 3;": "rotate",
        "object (a) box; change (a) bend 3 axes = 3;": "axis",
        "signal (s) sine(time);": "sin",
        "object (ball) box; change (bal) scale 2;": "ball",
        "object (a) box; signal (s) a.positon;": "position",
    }.items():
        with pytest.raises(r4.ScriptError) as caught:
            r4.loads(text)
        assert f"hint: did you mean {near!r}?" in caught.value.__notes__


def test_lists_of_lists_do_not_fill_the_memory() -> None:
    """A list named by the next one, and so on: refused before there are too many values."""
    text = "signal (a0) {1, 2};" + "".join([f"signal (a{i + 1}) {{a{i}, a{i}}};" for i in range(60)])
    with pytest.raises(r4.ScriptError, match="come to more than 10000000 values"):
        r4.loads(text)
    column = "{" + ", ".join(["{1}"] * 5000) + "}"
    row = "{{" + ", ".join(["1"] * 5000) + "}}"
    with pytest.raises(r4.ScriptError, match="more than 10000000 numbers"):
        r4.loads(f"signal (a) {column} + {row};")
    with pytest.raises(r4.ScriptError, match="more than 10000000 numbers"):
        r4.loads(f"signal (a) matmul({column}, {row});")


def test_nothing_is_left_of_what_is_refused() -> None:
    """A scene is read whole or not at all."""
    scene = r4.Scene()
    from reactive4d.scefo.parsing import parse
    from reactive4d.scefo.reading import read_into

    with pytest.raises(r4.ScriptError):
        read_into(scene, parse("object (a) box; change (a) sclae 2;"), folder=Path())
    assert len(scene) == 0
    assert not scene.signals


# -- a thousand bad scripts --------------------------------------------------------------------------------------------

TEXTS = [*EXAMPLES, *[path.read_text(encoding="utf-8") for path in CORPUS], COMMENTED]
TEXTS += [
    path.read_text(encoding="utf-8")
    for path in resources("reactive4d.scefo").joinpath("scenes").iterdir()
    if path.name.endswith(".scefo")
]
WORDS = sorted({word for text in TEXTS for word in re.findall(r'"[^"\n]*"|[\w.]+|[^\w\s]', text)})


def mutated(random: Random) -> str:
    """A script in which some words are others, are gone, or stand twice, or some statements stand elsewhere."""
    text = random.choice(TEXTS)
    for _ in range(random.choice([1, 1, 1, 2, 4])):
        words = re.split(r'("[^"\n]*"|[\w.]+|[^\w\s])', text)
        i, j = random.randrange(len(words)), random.randrange(len(words))
        kind = random.randint(0, 8)
        if kind == 0:
            words[i], words[j] = words[j], words[i]
        elif kind == 1:
            words[i] = random.choice(WORDS)
        elif kind == 2:
            words[i : i + random.choice([1, 2, 9])] = []
        elif kind == 3:
            words[i:i] = [" ", random.choice(WORDS), " "]
        elif kind == 4:
            statements = text.split(";")
            random.shuffle(statements)
            words = [";".join(statements)]
        elif kind == 5:
            words = [text, random.choice([*TEXTS, *WRONG])]
        elif kind > 6:
            numbers = [k for k, word in enumerate(words) if re.fullmatch(r"[\d.]+", word)] or [i]
            words[random.choice(numbers)] = random.choice(["0", "2", "0.5", "7", "1e-3", "-1", "1e300"])
        else:
            words[i] = random.choice(["0", "-1", "1e308", "inf", "none", "{}", "time", '"x"', "<0, 1>", "{a: 1}"])
        text = "".join(words)
    return text


def is_read(text: str, folder: Path) -> bool:
    """Whether a text is a scene, which then can be written and read again; if not, its error is a good one."""
    lines = text.split("\n")
    try:
        scene = r4.loads(text, file="fuzz.scefo", folder=folder)
    except r4.ScriptError as caught:
        error = caught
    else:
        again = r4.dumps(scene)
        assert r4.dumps(r4.loads(again, folder=folder)) == again
        return True
    line, column = error.line or 0, error.column or 0
    assert error.file == "fuzz.scefo"
    assert 1 <= line <= len(lines), text
    assert 1 <= column <= len(lines[line - 1]) + 1, text
    assert error.__notes__[-1].endswith("^")
    return False


@pytest.mark.parametrize("part", range(10))
def test_mutated_scripts_end_in_a_scene_or_in_a_script_error(part: int, folder: Path) -> None:
    """1,000 of them: never another exception, a hang, or half a scene; and whole scenes are written again."""
    random = Random(part)

    good = sum(is_read(mutated(random), folder) for _ in range(100))

    assert 5 < good < 95
