"""From tree to scene: each statement in its turn makes, changes or names something. Nothing of it is half done.

What is refused is told with its place; then the scene is thrown away.
"""

from collections.abc import Sequence
from pathlib import Path as FilePath
from typing import Any, Final

from reactive4d.errors import ScriptError, hint
from reactive4d.geometry import files
from reactive4d.model import places
from reactive4d.model.changes import Change as ModelChange
from reactive4d.model.kinds.models import Model
from reactive4d.model.lanes import entry_of
from reactive4d.model.objects import Anything, Object
from reactive4d.model.places import Entry
from reactive4d.model.registries import KINDS
from reactive4d.model.scenes import Scene
from reactive4d.model.settings import Setting
from reactive4d.scefo.classics import SET_PARAMETER, named_pair, spelled_out
from reactive4d.scefo.contents import content_of, value_of
from reactive4d.scefo.memories import Defined, Memory, Phrase, Told, Worded
from reactive4d.scefo.operators import is_live
from reactive4d.scefo.refusals import near, refusing, wrong
from reactive4d.scefo.scopes import Scope
from reactive4d.scefo.strangers import FIRST, Stranger, change_called, kind_called
from reactive4d.scefo.trees import (
    Attribute,
    Change,
    Constant,
    Create,
    Define,
    Expression,
    Name,
    Operation,
    Parameter,
    Path,
    Read,
    Script,
    Show,
    Statement,
    Template,
    Text,
    Use,
)
from reactive4d.signals.keys import Keys
from reactive4d.signals.sources import Parameter as ModelParameter
from reactive4d.signals.sources import Variable

__all__ = ["FOLDER", "MADE_OF", "NAMELESS", "SOURCE", "TEMPLATE", "class_of", "read_into", "reads_files"]

NAMELESS: Final = "_"  # a name that begins so is known to the script alone
FOLDER: Final = "source_folder"
SOURCE: Final = "source"
TEMPLATE: Final = "template"
MADE_OF: Final = "prototype"
_ENABLED: Final[Setting[Any]] = vars(ModelChange)["enabled"]


def read_into(scene: Scene, script: Script, *, folder: FilePath) -> None:
    """Fill a scene that is empty with what a script says.

    Args:
        scene: that holds nothing.
        script: the tree.
        folder: where the files that it reads lie, or below.

    Raises:
        ScriptError: with line and column; then nothing is in the scene.
    """
    reader = _Reader(script, folder)
    for statement in script.statements:
        reader.read(statement)
    reader.memory.after = script.after
    scene.update(reader.shown)
    scene.signals.update(reader.signals)
    scene.remembered = reader.memory


def class_of(prototype: Any) -> type[Object]:
    """Of which class an object is that is made from a prototype: of the same, if that is known.

    >>> import reactive4d as r4
    >>> class_of(r4.Sphere()).__name__, class_of(r4.keys({0: r4.Box(), 2: r4.Torus()})).__name__
    ('Sphere', 'Object')
    """
    if isinstance(prototype, Object):
        return type(prototype)
    if isinstance(prototype, Keys):
        found: list[Any] = [type(key.value) for key in prototype.curve.keys]
        if issubclass(found[0], Object) and all(kind is found[0] for kind in found):
            return found[0]
    return Object


def reads_files(obj: Object) -> bool:
    """Whether the setting `source` of an object names a file that is read; somebody's own kind may mean another."""
    setting = obj.setting(SOURCE)
    return isinstance(setting, Anything) or setting is Model.settings[SOURCE]


class _Reader:
    """A scene that is being read."""

    def __init__(self, script: Script, folder: FilePath) -> None:
        self.folder = folder
        self.scope = Scope(script.statements)
        self.memory = Memory()
        self.shown: dict[str, Object] = {}
        self.signals: dict[str, Any] = {}
        self.number = 0

    def read(self, statement: Statement) -> None:
        """One statement."""
        self.number += 1
        with refusing(statement.at):
            if isinstance(statement, Change):
                self.change(statement)
            elif isinstance(statement, Define):
                self.define(statement)
            elif isinstance(statement, Parameter):
                self.parameter(statement)
            elif isinstance(statement, Show):
                self.show(statement)
            else:
                self.scope.claim(statement.name)
                self.make(statement)

    # -- objects ---------------------------------------------------------------------------------------------------

    def make(self, statement: Read | Create | Template) -> None:
        """An object."""
        if not statement.is_hidden:
            _refuse_scene_name(statement.name)
        if isinstance(statement, Template):
            prototype = value_of(statement.prototype, self.scope)
            with refusing(statement.prototype.at):
                obj = self.extended(prototype)
        else:
            if isinstance(statement, Create):
                with refusing(statement.kind.at):
                    kind = kind_called(statement.kind.text)
            else:
                kind = Model
            obj = _made(kind)
        text = statement.name.text
        if not (statement.is_hidden and text.startswith(NAMELESS)):
            obj.name = text
        self.scope.define(statement.name, obj)
        if isinstance(statement, Read):
            self.file(obj, statement.file)
        names: set[str] = set()
        phrases = [self.setting(obj, setting, names) for setting in statement.settings]
        self.memory.objects[obj] = Told(statement, tuple(phrases))
        if not statement.is_hidden:
            self.shown[text] = obj

    def extended(self, prototype: Any) -> Object:
        """An object made from another one."""
        if isinstance(prototype, Object):
            return prototype.extend()
        if not is_live(prototype):
            raise hint(TypeError(f"expected an object, got {prototype!r}"), "template (new) old")
        if isinstance(prototype, Keys):
            for key in prototype.curve.keys:
                if key.value is not None and not isinstance(key.value, Object) and not is_live(key.value):
                    raise TypeError(f"expected an object, got {key.value!r}")
        obj = _made(class_of(prototype))
        obj.prototype = prototype
        return obj

    def file(self, obj: Object, file: Text) -> None:
        """Let a model be read from a file, once somebody asks for it."""
        with refusing(file.at):
            files.located(file.value, folder=self.folder)
            obj.assign(SOURCE, file.value)
            obj.assign(FOLDER, str(self.folder))

    def setting(self, obj: Object, attribute: Attribute, names: set[str]) -> Phrase:
        """A setting of an object, where it is made."""
        name = _name_of(attribute, "a setting", names)
        if name.text == "name" and "name" not in type(obj).settings:
            if not isinstance(attribute.value, Text):
                raise wrong("a name is a string", attribute.value.at, expected=("a string",))
            obj.name = attribute.value.value
            return Phrase.of(attribute, {})
        if name.text == MADE_OF:
            prototype = value_of(attribute.value, self.scope)
            with refusing(attribute.value.at):
                obj.prototype = prototype
            return Phrase.of(attribute, {})
        return Phrase.of(attribute, self.assigned([obj], name, attribute.value))

    def assigned(self, targets: Sequence[Object], name: Name, value: Expression, *, any_name: bool = False) -> Any:
        """Set a setting of objects; what no kind has is refused unless it was said that any name is meant."""
        first = targets[0]
        if not any_name and not isinstance(first, Stranger) and not _is_known(first, name.text):
            error = wrong(f"no kind has a setting {name.text!r}", name.at, expected=("the name of a setting",))
            near(error, name.text, type(first).settings)
            raise hint(error, f'to keep it nevertheless: change (…) set_parameter {{"{name.text}", …}}')
        if name.text == FOLDER and reads_files(first):
            raise hint(wrong("a script cannot choose where files are read", name.at), "they lie in its own folder")
        content = content_of(value, first.setting(name.text), self.scope)
        with refusing(value.at):
            for obj in targets:
                obj.parameters[name.text] = content
                if name.text == SOURCE and reads_files(obj):
                    obj.assign(FOLDER, str(self.folder))
        return {name.text: content}

    def show(self, statement: Show) -> None:
        """An object, put into the scene."""
        name = statement.name
        target = self.scope.object(Path((statement.target.text,), at=statement.target.at))
        if self.scope.things.get(name.text) is not target:
            self.scope.define(name, target)
        if name.text in self.shown:
            raise wrong(f"{name.text!r} is in the scene by now", name.at, expected=("another name",))
        _refuse_scene_name(name)
        self.shown[name.text] = target
        self.memory.shows[name.text] = places.last(), statement.notes

    # -- changes ---------------------------------------------------------------------------------------------------

    def change(self, statement: Change) -> None:
        """Changes of some objects."""
        targets = [self.scope.object(path) for path in statement.targets]
        for i, (obj, path) in enumerate(zip(targets, statement.targets, strict=True)):
            if any(other is obj for other in targets[:i]):
                raise wrong(f"{path} stands twice", path.at, expected=("another object",))
        self.memory.heads[self.number] = statement.notes
        for operation in statement.operations:
            with refusing(operation.at):
                self.operation(targets, operation)

    def operation(self, targets: list[Object], operation: Operation | Use) -> None:
        """One change, put at the end of the lists of some objects."""
        phrases: tuple[Phrase, ...] = ()
        if isinstance(operation, Use):
            change = self.scope.change(operation.name)
        elif operation.operator.text in (SET_PARAMETER, TEMPLATE):
            self.told(targets, operation)
            return
        else:
            change, phrases = self.made(operation)
            if operation.label is not None:
                self.scope.define(operation.label, change)
            if not targets:
                self.memory.loose[change] = Worded(operation, phrases, self.number, places.last())
        for obj in targets:
            entry = _appended(obj, change)
            self.memory.entries[entry] = Worded(operation, phrases, self.number, entry.place)

    def made(self, operation: Operation) -> tuple[ModelChange, tuple[Phrase, ...]]:
        """A change with its values."""
        operator = operation.operator
        given = [FIRST if attribute.name is None else attribute.name.text for attribute in operation.attributes]
        with refusing(operator.at):
            kind = change_called(operator.text, tuple([name for name in given if name not in ("enabled", "name")]))
        contents: dict[str, Any] = {}
        phrases: list[Phrase] = []
        title: str | None = None
        for attribute in operation.attributes:
            said: dict[str, Any] = {}
            for part in spelled_out(kind.script, attribute) if attribute.name is None else [attribute]:
                name = self.named(kind, part)
                if name == "name" and name not in kind.indices:
                    title = _string(part.value)
                    continue
                if name in contents:
                    raise wrong(f"{name!r} is given twice", part.at, expected=("another attribute",))
                setting = _ENABLED if name == "enabled" else kind.settings[kind.indices[name]]
                said[name] = contents[name] = content_of(part.value, setting, self.scope)
            phrases.append(Phrase.of(attribute, said))
        made = kind.__new__(kind)
        ModelChange.__init__(made, **contents)
        if title is not None:
            made.name = title
        elif operation.label is not None and not operation.label.text.startswith(NAMELESS):
            made.name = operation.label.text
        return made, tuple(phrases)

    def named(self, kind: type[ModelChange], attribute: Attribute) -> str:
        """The name of an attribute of a change; the first value may stand without."""
        names = [*kind.indices]
        if attribute.name is None:
            if kind.positional:
                return names[0]
            error = wrong(f"{kind.script} takes no value without a name", attribute.at, expected=names)
            raise hint(error, f"its attributes are {', '.join(names)}")
        name = attribute.name.text
        if name not in kind.indices and name not in ("enabled", "name"):
            error = wrong(f"{kind.script} has no attribute {name!r}", attribute.name.at, expected=names)
            raise near(error, name, [*names, "enabled"])
        return name

    def told(self, targets: list[Object], operation: Operation) -> None:
        """What is said in a change statement and is no entry of a list: a setting by its name, or a prototype."""
        word = operation.operator.text
        if operation.label is not None:
            raise wrong(f"{word} has no name of its own", operation.label.at, expected=(f"'{word}'",))
        if not targets:
            raise wrong(f"{word} is for objects, and here are none", operation.at, expected=("an object",))
        if not operation.attributes:
            raise wrong(f"{word} needs a value", operation.operator.at, expected=("a value",))
        names: set[str] = set()
        for attribute in operation.attributes:
            if word == TEMPLATE:
                self.prototype(targets, attribute)
            else:
                self.set_parameter(targets, operation, attribute, names)

    def prototype(self, targets: list[Object], attribute: Attribute) -> None:
        """Another prototype for objects that were made before."""
        if attribute.name is not None:
            raise wrong("template takes one value, without a name", attribute.at, expected=("an object",))
        value = value_of(attribute.value, self.scope)
        with refusing(attribute.value.at):
            for obj in targets:
                obj.prototype = value

    def set_parameter(self, targets: list[Object], operation: Operation, attribute: Attribute, names: set[str]) -> None:
        """A setting of objects by its name, known or not."""
        if attribute.name is None:
            text, value = named_pair(attribute.value, "parameter")
            name = Name(text, at=attribute.value.at)
        else:
            name, value = _name_of(attribute, "a parameter", names), attribute.value
        contents = self.assigned(targets, name, value, any_name=attribute.name is None)
        for obj in targets:
            place = places.last()
            phrase = Phrase.of(attribute, contents)
            worded = Worded(operation, (phrase,), self.number, place)
            self.memory.assignments.setdefault(obj, {})[name.text] = worded

    # -- names of values -------------------------------------------------------------------------------------------

    def define(self, statement: Define) -> None:
        """A name for a signal or a constant; a variable is a signal of its own."""
        self.scope.claim(statement.name)
        value = value_of(statement.value, self.scope)
        name = statement.name.text
        is_named = not name.startswith(NAMELESS)
        if statement.word == "variable":
            with refusing(statement.value.at):
                value = Variable[Any](value, name=name if is_named else None)
        elif is_named and is_live(value) and not isinstance(statement.value, Path | Constant):
            value.name = name
        content = value.source if isinstance(value, Variable) else value
        self.entered(statement, value, Phrase.of(Attribute(None, statement.value), {"": content}))

    def parameter(self, statement: Parameter) -> None:
        """What a reader drives."""
        self.scope.claim(statement.name)
        told: dict[str, Any] = {}
        names: set[str] = set()
        for setting in statement.settings:
            name = _name_of(setting, "a parameter's attribute", names)
            if name.text not in ("bounds", "doc", "name"):
                expected = ("bounds", "doc", "name")
                raise wrong(f"a parameter has no {name.text!r}, but {', '.join(expected)}", name.at, expected=expected)
            told[name.text] = value_of(setting.value, self.scope)
            if name.text != "bounds":
                _string(setting.value)
        default = value_of(statement.default, self.scope)
        with refusing(statement.default.at):
            made: ModelParameter[Any] = ModelParameter(told.pop("name", statement.name.text), default, **told)
        self.entered(statement, made, Phrase.of(Attribute(None, statement.default), {}))

    def entered(self, statement: Define | Parameter, value: Any, phrase: Phrase) -> None:
        """Let a name stand for a value, from here on and for who holds the scene."""
        name = statement.name.text
        self.scope.define(statement.name, value)
        if not name.startswith(NAMELESS):
            self.signals[name] = value
        self.memory.definitions[name] = Defined(statement, phrase, value, places.last())


def _made(kind: type[Object]) -> Object:
    """An object of a kind without settings; a user's own constructor may want more than a script tells."""
    obj = kind.__new__(kind)
    Object.__init__(obj)
    return obj


def _appended(obj: Object, change: ModelChange) -> Entry:
    """The entry of a change at the end of an object's list."""
    obj.changes.append(change)
    return entry_of(obj.own(change.lane).content[-1])


def _name_of(attribute: Attribute, what: str, names: set[str]) -> Name:
    """The name of an attribute that needs one, and is given once."""
    if attribute.name is None:
        raise wrong(f"expected {what}, name = value", attribute.at, expected=("a name",))
    if attribute.name.text in names:
        raise wrong(f"{attribute.name.text!r} is given twice", attribute.name.at, expected=("another name",))
    names.add(attribute.name.text)
    return attribute.name


def _string(tree: Expression) -> str:
    if not isinstance(tree, Text):
        raise wrong("expected a string", tree.at, expected=("a string",))
    return tree.value


def _is_known(obj: Object, name: str) -> bool:
    """Whether any kind has a setting of this name: an object may become of that kind."""
    return name in type(obj).settings or any(name in kind.settings for kind in list(KINDS.values()))


def _refuse_scene_name(name: Name) -> None:
    if not name.text or "/" in name.text:
        error: ScriptError = wrong(f"{name.text!r} is not a name for an object", name.at, expected=("a name",))
        raise hint(error, "a string without a slash")
