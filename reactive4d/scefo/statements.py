"""From scene to tree: one statement after the other, in the order of the history.

Objects, changes and named signals stand where they have their place in the order of changes. What a statement mentions
comes before it, if need be earlier than its own place. Where things mention each other in a circle, the objects are
made first, and the settings that close the circle are set by `set_parameter` afterwards.
"""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any, Final, NamedTuple

from reactive4d.arrays import ARRAY, same
from reactive4d.errors import hint
from reactive4d.model.changes import Change as ModelChange
from reactive4d.model.kinds.models import Model
from reactive4d.model.objects import Object
from reactive4d.model.places import Entry, Place
from reactive4d.model.registries import KINDS, spoken_name
from reactive4d.model.scenes import Scene
from reactive4d.model.settings import Setting
from reactive4d.scefo.circles import circles
from reactive4d.scefo.classics import SET_PARAMETER
from reactive4d.scefo.collecting import Collection, assigned_to, gating_of, owner_of
from reactive4d.scefo.memories import Memory, Worded
from reactive4d.scefo.naming import Naming, called
from reactive4d.scefo.operators import is_live
from reactive4d.scefo.phrasing import Phrasing, is_plain
from reactive4d.scefo.reading import FOLDER, MADE_OF, NAMELESS, SOURCE, TEMPLATE, class_of, reads_files
from reactive4d.scefo.strangers import FIRST, Stranger
from reactive4d.scefo.trees import (
    NO_NOTES,
    Attribute,
    Change,
    Create,
    Define,
    Items,
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
from reactive4d.scefo.unparsing import NotWritableError, Unparsing
from reactive4d.signals.sources import Variable

__all__ = ["script_of"]

_ENABLED: Final[Setting[Any]] = vars(ModelChange)["enabled"]


def script_of(scene: Scene, *, folder: FilePath | None = None) -> Script:
    """The tree of a scene.

    Args:
        scene: to be written.
        folder: where the script will lie: files are named as seen from there. None: as they are.

    Raises:
        NotWritableError: it holds what no script can say, or reads a file outside of the folder.
    """
    return _Writer(scene, folder).script()


class _Run(NamedTuple):
    """One change, put into the lists of several objects at once."""

    change: ModelChange
    entries: tuple[Entry, ...]
    worded: Worded | None


class _Writer:
    """A scene on its way to statements."""

    def __init__(self, scene: Scene, folder: FilePath | None) -> None:
        self.scene = scene
        self.folder = None if folder is None else folder.resolve()
        self.memory: Memory = scene.remembered if isinstance(scene.remembered, Memory) else Memory()
        self.collection = Collection(scene)
        self.naming = Naming(scene)
        self.unparsing = Unparsing(self.naming.name_of, self.naming.of_signal, None)
        self.phrasing = Phrasing(self.unparsing, self.naming.free)
        self.unparsing.count(self.collection.roots, is_named=lambda x: owner_of(x) is not None)
        self.named = {**scene.signals, **self._remembered()}
        for value in self.named.values():
            if is_live(value):
                # What has a name is always defined.
                self.unparsing.counts[id(value)] = self.unparsing.counts.get(id(value), 0) + 2
        self.known = {name for kind in list(KINDS.values()) if "." not in spoken_name(kind) for name in kind.settings}
        self.contents = {id(obj): self._contents(obj) for obj in self.collection.objects}
        self.late = self._late()
        self.runs = _runs(self.collection.objects, self.memory)
        self.labelled = self._labelled()
        self._recall_names()
        self.statements: list[Statement] = []
        self.heads = dict(self.memory.heads)
        self.done: set[int] = set()  # ids of objects and changes
        self.defined: set[str] = set()
        self.taken = 0  # of the definitions that became necessary
        self.waiting: list[tuple[Object, str]] = []  # settings that can be set by now
        self.is_catching_up = False
        # The change statement under way.
        self.operations: list[Operation | Use] = []
        self.targets: tuple[Path, ...] = ()
        self.number: int | None = None
        # What the scene shows, and how much of it is shown by now.
        self.order: list[tuple[str, Object]] = [*scene.items()]
        self.ranks = {id(obj): i for i, (_, obj) in reversed([*enumerate(self.order)])}
        self.shown = 0

    def _remembered(self) -> dict[str, Any]:
        """Signals that have a name in the script that was read, though not in the scene, and are still used."""
        counts, naming = self.unparsing.counts, self.naming
        found: dict[str, Any] = {}
        for name, (_, _, value, _) in self.memory.definitions.items():
            is_used = is_live(value) and counts.get(id(value), 0) > 0
            if is_used and name not in naming.taken and id(value) not in naming.signals:
                naming.taken.add(name)
                naming.signals[id(value)] = name
                found[name] = value
        return found

    # -- what can be said when -------------------------------------------------------------------------------------

    def _contents(self, obj: Object) -> dict[str, Any]:
        """What was assigned to an object's settings; files as seen from the script's folder."""
        found = assigned_to(obj)
        source: Any = found.get(SOURCE)
        if self.folder is not None and reads_files(obj) and isinstance(source, str) and source:
            found[SOURCE] = self._seen_from_folder(obj, source)
        return found

    def _seen_from_folder(self, obj: Object, source: str) -> str:
        folder: Any = obj.attribute(FOLDER).at(0.0)
        home = FilePath.cwd() if folder is None else FilePath(folder)
        if home.resolve() == self.folder and not FilePath(source).is_absolute():
            return source
        assert self.folder is not None
        place = (home / source).resolve()
        if not place.is_relative_to(self.folder):
            error = NotWritableError(f"{obj.name}: the file {place} lies outside of {self.folder}")
            raise hint(error, "a script reads files of its own folder: save it there, or copy them")
        return place.relative_to(self.folder).as_posix()

    def _late(self) -> dict[int, list[str]]:
        """The settings of each object that are set after it was made, by its id."""
        found: dict[int, list[str]] = {id(obj): [] for obj in self.collection.objects}
        for obj in self.collection.objects:
            remembered = self.memory.assignments.get(obj, {})
            for name, content in {**self.contents[id(obj)], MADE_OF: _varying(obj)}.items():
                is_known = name in type(obj).settings or name in self.known or isinstance(obj, Stranger)
                if name in remembered or not (is_known or name == MADE_OF) or obj in self._mentioned(content):
                    found[id(obj)].append(name)

        things = [*self.collection.objects, *self.collection.changes]
        numbers = circles(things, lambda x: self._needs(x, found))
        for obj in self.collection.objects:
            for name, content in {**self.contents[id(obj)], MADE_OF: _varying(obj)}.items():
                if name not in found[id(obj)] and any(
                    numbers[id(y)] == numbers[id(obj)] for y in self._mentioned(content)
                ):
                    found[id(obj)].append(name)
        return found

    def _mentioned(self, content: Any) -> tuple[Any, ...]:
        return self.collection.mentioned(content)

    def _needs(self, x: Any, late: dict[int, list[str]]) -> list[Any]:
        """What has to be there before an object is made, or a change told."""
        if isinstance(x, Object):
            left = [content for name, content in self.contents[id(x)].items() if name not in late[id(x)]]
            if MADE_OF not in late[id(x)]:
                left.append(x.prototype_content)
        else:
            left = [*x.contents, gating_of(x)]
        return [y for content in left for y in self._mentioned(content)]

    def _labelled(self) -> set[int]:
        """The ids of the changes that need names: they have one, are said more than once, or are mentioned."""
        times: dict[int, int] = {}
        for run in self.runs:
            times[id(run.change)] = times.get(id(run.change), 0) + 1
        mentioned = {id(x) for root in self.collection.roots for x in self._mentioned(root)}
        return {
            id(change)
            for change in self.collection.changes
            if change.is_named or times.get(id(change), 0) != 1 or id(change) in mentioned
        }

    def _recall_names(self) -> None:
        """Use the names again that are known to the script alone."""
        for obj in self.collection.objects:
            told = self.memory.objects.get(obj)
            if told is not None and told.tree.is_hidden:
                self.naming.remember(obj, told.tree.name.text)
        worded = [(run.change, run.worded) for run in self.runs] + [*self.memory.loose.items()]
        for change, words in worded:
            label = words.tree.label if words is not None and isinstance(words.tree, Operation) else None
            if label is not None and id(change) in self.labelled:
                self.naming.remember(change, label.text)

    # -- the whole -------------------------------------------------------------------------------------------------

    def script(self) -> Script:
        """All statements."""
        events: list[tuple[Place, int, Any]] = []
        for obj in self.collection.objects:
            events.append((obj.born, 0, obj))
            for name, worded in self.memory.assignments.get(obj, {}).items():
                if name in self.contents[id(obj)]:
                    events.append((worded.place, 1, (obj, name)))
        events += [(run.entries[0].place, 2, run) for run in self.runs]
        events += [(w.place, 5, change) for change, w in self.memory.loose.items() if id(change) in self.labelled]
        for name in self.named:
            if name in self.memory.definitions:
                events.append((self.memory.definitions[name].place, 3, name))
        for i, (name, _) in enumerate(self.order):
            if name in self.memory.shows:
                events.append((self.memory.shows[name][0], 4, i))
        for _, _, event in sorted(events, key=lambda event: event[:2]):
            self._event(event)
        for name in self.scene.signals:
            self._define(name)
        self._show(len(self.order))
        self._end_change()
        return Script(tuple(self.statements), self.memory.after)

    def _event(self, event: Any) -> None:
        """What has its place in the order of the history."""
        if isinstance(event, Object):
            self._need([event])
        elif isinstance(event, _Run):
            self._change(event)
        elif isinstance(event, ModelChange):
            self._need([event])
        elif isinstance(event, str):
            self._define(event)
        elif isinstance(event, int):
            self._show(event + 1)
        else:
            obj, name = event
            self._need([obj])
            self._assign(obj, name)

    def _say(self, statement: Statement) -> None:
        """Add a statement; a change statement under way ends before it."""
        self._end_change()
        self.statements.append(statement)

    def _end_change(self) -> None:
        if self.operations:
            notes = NO_NOTES if self.number is None else self.heads.pop(self.number, NO_NOTES)
            self.statements.append(Change(self.targets, tuple(self.operations), notes=notes))
            self.operations = []

    def _operate(self, targets: Iterable[Object], operation: Operation | Use, number: int | None) -> None:
        """Add an operation to the statement under way if it has the same objects, else to a new one."""
        paths = tuple([Path((self.naming.of_object(obj),)) for obj in targets])
        if (paths, number) != (self.targets, self.number):
            self._end_change()
        self.targets, self.number = paths, number
        self.operations.append(operation)

    def _need(self, things: Iterable[Any]) -> None:
        """Tell objects and changes that were not told yet, after what they need; then what waited for them."""
        todo = self._roots([x for x in things if id(x) not in self.done])[::-1]
        under_way: set[int] = set()
        while todo:
            x = todo[-1]
            if id(x) in self.done:
                todo.pop()
                continue
            missing = [y for y in self._needs(x, self.late) if id(y) not in self.done]
            if not missing:
                todo.pop()
                self._make(x) if isinstance(x, Object) else self._foretell(x)
                continue
            if id(x) in under_way:
                raise NotWritableError(f"{x.name} mentions itself, by way of {missing[0].name}")
            under_way.add(id(x))
            todo += reversed(missing)
        if not self.is_catching_up:
            self.is_catching_up = True
            while self.waiting:
                self._assign(*self.waiting.pop(0))
            self.is_catching_up = False

    def _roots(self, things: list[Any]) -> list[Any]:
        """These things, after the objects that the scene shows before any of those that they need."""
        seen: set[int] = set()
        rank = self.shown
        todo = [*things]
        while todo:
            x = todo.pop()
            if id(x) in seen or id(x) in self.done:
                continue
            seen.add(id(x))
            todo += self._needs(x, self.late)
            last = -1 if self._is_hidden(x) else self.ranks.get(id(x), -1)
            if last > rank:
                todo += [obj for _, obj in self.order[rank:last]]
                rank = last
        return [*[obj for _, obj in self.order[self.shown : rank]], *things]

    def _is_hidden(self, x: Any) -> bool:
        """Whether an object was made hidden, and shown by a statement of its own."""
        told = self.memory.objects.get(x) if isinstance(x, Object) else None
        return told is not None and told.tree.is_hidden and told.tree.name.text in self.memory.shows

    # -- objects ---------------------------------------------------------------------------------------------------

    def _make(self, obj: Object) -> None:
        """The statement that makes an object, and those that show what waited for it."""
        self.done.add(id(obj))
        name = self.naming.of_object(obj)
        told = self.memory.objects.get(obj)
        late = self.late[id(obj)]
        contents = {n: content for n, content in self.contents[id(obj)].items() if n not in late}
        prototype = None if MADE_OF in late else obj.prototype_content
        is_turn = self.shown < len(self.order) and self.order[self.shown] == (name, obj)
        is_hidden = not is_turn or self._is_hidden(obj)
        file: Any = contents.get(SOURCE)
        is_read = type(obj) is Model and prototype is None and isinstance(file, str) and file != ""
        if is_read:
            del contents[SOURCE]

        phrases = () if told is None else told.phrases
        named = {str(phrase.tree.name): phrase.tree.notes for phrase in phrases if not phrase.contents}

        def said(setting: str, content: Any) -> Attribute:
            value = self.phrasing.value(content, obj.setting(setting), f"{obj.name}.{setting}")
            return Attribute(Name(setting), value)

        pseudo: list[Attribute] = []
        is_anonymous = is_hidden and name.startswith(NAMELESS)
        if obj.is_named and (is_anonymous or obj.name != name):
            pseudo.append(Attribute(Name("name"), Text(obj.name), notes=named.get("name", NO_NOTES)))
        made_of = None if prototype is None else self.phrasing.value(prototype, None, f"{obj.name}.{MADE_OF}")
        is_extension = prototype is not None and class_of(prototype) is type(obj)
        if made_of is not None and not is_extension:
            pseudo.append(Attribute(Name(MADE_OF), made_of, notes=named.get(MADE_OF, NO_NOTES)))
        settings = (*pseudo, *self.phrasing.attributes(contents, phrases, said))
        self._take_definitions()
        notes = NO_NOTES if told is None else told.tree.notes
        statement: Statement
        if is_read:
            statement = Read(Text(file), Name(name), settings, is_hidden=is_hidden, notes=notes)
        elif is_extension and made_of is not None:
            statement = Template(Name(name), made_of, settings, is_hidden=is_hidden, notes=notes)
        else:
            kind = Name(called(type(obj)))
            statement = Create(Name(name), kind, settings, is_hidden=is_hidden, notes=notes)
        self._say(statement)
        remembered = self.memory.assignments.get(obj, {})
        self.waiting += [(obj, n) for n in late if n not in remembered]
        self.shown += not is_hidden
        while self.shown < len(self.order):
            name, obj = self.order[self.shown]
            if id(obj) not in self.done or name in self.memory.shows:
                break
            self._show(self.shown + 1)

    def _show(self, count: int) -> None:
        """Show the first objects of the scene, as many as there shall be."""
        while self.shown < count:
            i = self.shown
            name, obj = self.order[i]
            self._need([obj])
            if self.shown == i:
                self.shown += 1
                notes = self.memory.shows[name][1] if name in self.memory.shows else NO_NOTES
                self._say(Show(Name(name), Name(self.naming.of_object(obj)), notes=notes))

    def _assign(self, obj: Object, name: str) -> None:
        """A setting, after the object was made."""
        content = obj.prototype_content if name == MADE_OF else self.contents[id(obj)][name]
        self._need(self._mentioned(content))
        where = f"{obj.name}.{name}"
        if name == MADE_OF:
            value = self.phrasing.value(content, None, where)
            self._take_definitions()
            self._operate([obj], Operation(Name(TEMPLATE), (Attribute(None, value),)), None)
            return

        def said(setting: str, content: Any) -> Attribute:
            value = self.phrasing.value(content, obj.setting(setting), where)
            if setting in self.known or setting in type(obj).settings:
                return Attribute(Name(setting), value)
            return Attribute(None, Items((Text(setting), value)))

        worded = self.memory.assignments.get(obj, {}).get(name)
        attributes = self.phrasing.attributes({name: content}, () if worded is None else worded.phrases, said)
        self._take_definitions()
        notes = NO_NOTES if worded is None else worded.tree.notes
        operation = Operation(Name(SET_PARAMETER), tuple(attributes), notes=notes)
        self._operate([obj], operation, None if worded is None else worded.number)

    # -- changes ---------------------------------------------------------------------------------------------------

    def _change(self, run: _Run) -> None:
        """A change in the lists of some objects."""
        change = run.change
        owners = [entry.owner for entry in run.entries]
        is_told = id(change) in self.done
        self._need([*owners, *(() if is_told else self._needs(change, self.late))])
        number = None if run.worded is None else run.worded.number
        if id(change) in self.done:
            notes = NO_NOTES if run.worded is None else run.worded.tree.notes
            self._operate(owners, Use(Name(self.naming.label(change)), notes=notes), number)
            return
        operation = self._told(change, run.worded)
        self.done.add(id(change))
        self._operate(owners, operation, number)

    def _foretell(self, change: ModelChange) -> None:
        """A change that is mentioned before it stands in any list."""
        self.done.add(id(change))
        worded = self.memory.loose.get(change)
        operation = self._told(change, worded)
        notes = NO_NOTES if worded is None else self.heads.pop(worded.number, NO_NOTES)
        self._say(Change((), (operation,), notes=notes))

    def _told(self, change: ModelChange, worded: Worded | None) -> Operation:
        """A change with its values."""
        kind = type(change)
        phrases = () if worded is None else worded.phrases
        worded_names = {name for phrase in phrases for name in phrase.contents}
        contents = {
            setting.name: content
            for setting, content in zip(kind.settings, change.contents, strict=True)
            if setting.name in worded_names or not _is_default(content, setting)
        }
        gating = gating_of(change)
        if gating is not True or "enabled" in worded_names:
            contents["enabled"] = gating
        first = kind.settings[0].name if kind.positional else FIRST

        def said(name: str, content: Any) -> Attribute:
            setting = _ENABLED if name == "enabled" else kind.settings[kind.indices[name]]
            value = self.phrasing.value(content, setting, f"{change.name}.{name}")
            return Attribute(None if name == first else Name(name), value)

        attributes = self.phrasing.attributes(contents, phrases, said)
        label = self.naming.label(change) if id(change) in self.labelled else None
        if change.is_named and change.name != label:
            attributes.append(Attribute(Name("name"), Text(change.name)))
        self._take_definitions()
        notes = NO_NOTES if worded is None else worded.tree.notes
        named = None if label is None else Name(label)
        return Operation(Name(called(kind)), tuple(attributes), label=named, notes=notes)

    # -- names of values -------------------------------------------------------------------------------------------

    def _define(self, name: str) -> None:
        """A signal or a value that has a name in the scene."""
        if name in self.defined:
            return
        value = self.named[name]
        self._need(self._mentioned(value))
        expression = self.phrasing.value(value, None, name)
        self._take_definitions()
        if name not in self.defined:
            self.defined.add(name)
            self._say(self._as_it_stood(Define("signal", Name(name), expression), value))

    def _take_definitions(self) -> None:
        """Add the definitions that became necessary since."""
        signals = {name: signal for signal, name in self.unparsing.names}
        while self.taken < len(self.unparsing.definitions):
            definition: Any = self.unparsing.definitions[self.taken]
            self.taken += 1
            self.defined.add(definition.name.text)
            self._say(self._as_it_stood(definition, signals.get(definition.name.text)))

    def _as_it_stood(self, made: Define | Parameter, value: Any) -> Statement:
        """The definition in the words and with the comments that it had."""
        old = self.memory.definitions.get(made.name.text)
        if old is None or type(old.tree) is not type(made):
            return made
        if isinstance(old.tree, Parameter):
            return old.tree if old.value is value and is_plain(old.tree) else replace(made, notes=old.tree.notes)
        content = value.source if isinstance(value, Variable) else value
        same = isinstance(made, Define) and old.tree.word == made.word and old.phrase.holds({"": content})
        return old.tree if same and is_plain(old.tree.value) else replace(made, notes=old.tree.notes)


def _is_default(content: Any, setting: Setting[Any]) -> bool:
    return content is setting.default or (type(content) is ARRAY and same(content, setting.default))


def _varying(obj: Object) -> Any:
    """The prototype of an object, if it varies."""
    content = obj.prototype_content
    return content if is_live(content) else None


def _runs(objects: Iterable[Object], memory: Memory) -> list[_Run]:
    """All entries in their order; those that put one change into several lists, one after the other, together."""
    entries = sorted([entry for obj in objects for entry in obj.own_entries()], key=lambda entry: entry.place)
    runs: list[list[Entry]] = []
    for entry in entries:
        last = runs[-1] if runs else []
        if (
            last
            and last[0].change is entry.change
            and all(other.owner is not entry.owner for other in last)
            and _number(memory, last[0]) == _number(memory, entry)
        ):
            last.append(entry)
        else:
            runs.append([entry])
    return [_Run(run[0].change, tuple(run), memory.entries.get(run[0])) for run in runs]


def _number(memory: Memory, entry: Entry) -> int | None:
    """The number of the statement that put a change into a list."""
    worded = memory.entries.get(entry)
    return None if worded is None else worded.number
