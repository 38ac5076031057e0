"""Records in the reference: fields with type, default, meaning and unit, an example, and where results come from.

Meaning and unit stand at the field, as facts or in a comment `#:`. A record that is made by hand has an example, in its
docstring or that of `mdr case --example`; a result names what returns it. Functions whose docstring has no Parameters
get a signature with types.
"""

import inspect
import re
from collections.abc import Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any

from sphinx.application import Sphinx
from sphinx.pycode import ModuleAnalyzer

import mdr
from mdr.files import examples
from mdr.tools.fields import facts_of

PLAIN = {  #: of annotations, as a reader would say it
    "Array": "ndarray",
    "Arms": "tuple of (float, float)",
    "collections.abc.Callable[..., typing.Any]": "callable",
    "Callable[..., float]": "callable",
    "ArrayLike": "array_like",
    "Any": "float or ndarray",
}
_listed: set[str] = set()  #: fields of the class that was described last, which autodoc need not list again


def words(cls: type, field: Field[Any]) -> str:
    """What stands at a field: its facts, or the comment above or beside it."""
    comments = ModuleAnalyzer.for_module(cls.__module__).find_attr_docs()
    return str(facts_of(field)) or " ".join(comments.get((cls.__name__, field.name), ())).strip()


def type_of(annotation: Any) -> str:
    """An annotation in plain words."""
    text = annotation.__name__ if isinstance(annotation, type) else str(annotation)
    text = re.sub(r"NDArray\[np\.u?([a-z]+)\d*_?\]", r"ndarray of \1", text)
    for code, plain in PLAIN.items():
        text = re.sub(rf"(?<![\w.]){re.escape(code)}(?!\w)", plain, text)
    return text


def default_of(field: Field[Any]) -> str:
    """The default of a field as one would write it, "" where there is none."""
    if field.default_factory is not MISSING:
        return repr(field.default_factory())
    return "" if field.default is MISSING else repr(field.default)


def example_of(cls: type) -> str:
    """A record of this class in one line, from the starting files; "" where there is none."""
    known = examples.SHAPES | examples.MATERIALS | examples.LAWS | examples.MOTIONS | examples.PULLS | examples.SHAKES
    if cls.__name__ not in known or ">>>" in (cls.__doc__ or ""):
        return ""
    return re.sub(r"\d+(?:\.\d+)?(?:e[-+]\d+)?", lambda number: brief(number[0]), f"mdr.{known[cls.__name__]!r}")


def brief(number: str) -> str:
    """A float as one would type it: 3e6 for 3000000.0."""
    short = re.sub(r"e([-+])0*", lambda power: f"e{power[1].strip('+')}", f"{float(number):g}")
    return short if float(short) == float(number) and "e" in short else number


def makers(cls: type) -> Iterator[str]:
    """Names of what returns a record of this class: public functions, and what other public records hold."""
    for path, home in (("mdr", mdr), ("mdr.laws", mdr.laws), ("mdr.half_space", mdr.half_space)):
        for name, one in vars(home).items():
            public = name in mdr.__all__ if home is mdr else name[0] != "_"
            if public and inspect.isfunction(one) and _gives(inspect.signature(one).return_annotation, cls):
                yield f"{path}.{name}"
    for name in mdr.__all__:
        one = getattr(mdr, name)
        if inspect.isclass(one) and one is not cls:
            held = {field.name: field.type for field in fields(one)} if is_dataclass(one) else {}
            for member, raw in vars(one).items():
                if isinstance(raw, property):
                    held[member] = inspect.get_annotations(raw.fget).get("return")
            yield from (f"mdr.{name}.{member}" for member, annotation in held.items() if _gives(annotation, cls))


def _gives(annotation: Any, cls: type) -> bool:
    return cls.__name__ in re.findall(r"\w+", getattr(annotation, "__name__", str(annotation)))


def add_fields(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """At the end of the docstring of a record: an example or what returns it, and its fields."""
    if what != "class" or not is_dataclass(obj):
        return
    _listed.clear()
    if made := example_of(obj):
        lines += ["", ".. rubric:: Examples", "", ".. code-block:: python", "", f"   {made}", ""]
    elif ">>>" not in (obj.__doc__ or "") and (sources := sorted(makers(obj))):
        lines += ["", "Returned by " + ", ".join(f"`{one}`" for one in sources) + ".", ""]
    for field in fields(obj):
        told = words(obj, field)
        if told and field.name in inspect.get_annotations(obj):
            _listed.add(field.name)
            lines += ["", f".. py:attribute:: {field.name}", f"   :type: {type_of(field.type)}"]
            lines += [f"   :value: {default_of(field)}"] if default_of(field) else []
            lines += ["", f"   {told.replace('*', chr(92) + '*')}", ""]


def skip_fields(app: Sphinx, what: str, name: str, obj: Any, skip: bool, options: Any) -> bool | None:
    """Leave out what add_fields has listed."""
    return True if what == "class" and name in _listed else None


def add_types(
    app: Sphinx, what: str, name: str, obj: Any, options: Any, signature: str | None, answer: str | None
) -> tuple[str, str | None] | None:
    """A signature with types, where no section of the docstring has them."""
    if what != "function" or "----------" in (obj.__doc__ or ""):
        return None
    typed = inspect.signature(obj)
    given = [one.replace(annotation=type_of(one.annotation)) for one in typed.parameters.values()]
    text = str(typed.replace(parameters=given, return_annotation=inspect.Signature.empty)).replace("'", "")
    return text, type_of(typed.return_annotation)


def setup(app: Sphinx) -> dict[str, bool]:
    """Listen to autodoc, after numpydoc has set the docstring."""
    app.connect("autodoc-process-docstring", add_fields, priority=900)
    app.connect("autodoc-skip-member", skip_fields)
    app.connect("autodoc-process-signature", add_types, priority=400)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
