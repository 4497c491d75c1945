"""Reads the debug information to find the module of an address of the firmware image."""

from __future__ import annotations

import bisect
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, TypeVar

from elftools.dwarf.die import DIE
from elftools.elf.elffile import ELFFile

from traceability.sources import files_below

# A tuple that begins with two numbers: the first address of an item, and the address after its end.
Extent = TypeVar("Extent", bound=tuple[Any, ...])
NOWHERE = "other"  # name for padding, libraries and tables of the compiler
_ADDRESS = 0x03  # DW_OP_addr
_WRAPPERS = {"DW_TAG_typedef", "DW_TAG_const_type", "DW_TAG_volatile_type"}
_CLASSES = {"DW_TAG_structure_type", "DW_TAG_class_type", "DW_TAG_union_type"}


class Places:
    """The module to which each address in flash or RAM belongs. If the address belongs to several
    nested design modules, this module is the innermost of them. If the address belongs to no design
    module, the result is the module with the name of the source file."""

    def __init__(self, root: Path, elf: Path) -> None:
        self._modules = {
            path.stem for path in files_below(root, ("src", "extensions"), (".hpp", ".cpp"))
        }
        self._objects: list[tuple[int, int, DIE, str]] = []  # address, end, type and source
        self._functions: list[tuple[int, int, str]] = []
        self._defined: dict[str, DIE] = {}
        with elf.open("rb") as file:
            self._read(ELFFile(file))
            self._objects.sort(key=lambda item: item[:2])
            self._functions.sort()
            # Types are read now, because they can be read only while the file is open.
            self._members = {
                address: dict(self._bytes(die, 0, source))
                for address, _, die, source in self._objects
            }

    def of(self, address: int) -> str:
        """Returns the module of an address. Returns NOWHERE if the address belongs to no module."""
        if place := _at(self._objects, address):
            start, _, _, source = place
            return self._members[start].get(address - start, source)
        function = _at(self._functions, address)
        return function[2] if function else NOWHERE

    def _read(self, elf: ELFFile) -> None:
        tops = [unit.get_top_DIE() for unit in elf.get_dwarf_info().iter_CUs()]
        for top in tops:
            for die in _children(top, _CLASSES):
                if "DW_AT_byte_size" in die.attributes:
                    self._defined.setdefault(_path(die), die)
        for top in tops:
            source = self._module_of_file(_text(top, "DW_AT_name"))
            for die in _children(top, ("DW_TAG_variable", "DW_TAG_subprogram")):
                if die.tag == "DW_TAG_variable":
                    self._add_variable(die, source)
                else:
                    self._add_function(die, source)

    def _add_variable(self, die: DIE, source: str) -> None:
        location = die.attributes.get("DW_AT_location")
        kind = _type_of(die)
        if location is None or kind is None or not isinstance(location.value, list):
            return
        if len(location.value) != 5 or location.value[0] != _ADDRESS:
            return
        address = int.from_bytes(bytes(location.value[1:]), "little")
        size = self._size_of(kind)
        if size:
            self._objects.append((address, address + size, kind, source))

    def _add_function(self, die: DIE, source: str) -> None:
        low, high = die.attributes.get("DW_AT_low_pc"), die.attributes.get("DW_AT_high_pc")
        if low is None or high is None or low.value == 0:
            return
        end = high.value if high.form == "DW_FORM_addr" else low.value + high.value
        self._functions.append((low.value, end, self._module_of_function(die, source)))

    def _module_of_function(self, die: DIE, source: str) -> str:
        declared = die
        for name in ("DW_AT_abstract_origin", "DW_AT_specification"):
            if name in declared.attributes:
                declared = declared.get_DIE_from_attribute(name)
        if "DW_AT_specification" in declared.attributes:
            declared = declared.get_DIE_from_attribute("DW_AT_specification")
        parent = declared.get_parent()
        while parent is not None and parent.tag != "DW_TAG_compile_unit":
            if (
                parent.tag in _CLASSES
                and (name := _plain(_text(parent, "DW_AT_name"))) in self._modules
            ):
                return name
            parent = parent.get_parent()
        return source

    def _module_of_file(self, name: str) -> str:
        stem = Path(name).stem
        return stem if stem in self._modules else NOWHERE

    def _bytes(self, die: DIE, offset: int, module: str) -> Iterator[tuple[int, str]]:
        kind = self._resolved(die)
        if kind.tag == "DW_TAG_array_type":
            element = _type_of(kind)
            size = self._size_of(element) if element else 0
            for index in range(self._count_of(kind) if size else 0):
                assert element is not None
                yield from self._bytes(element, offset + index * size, module)
            return
        if kind.tag in _CLASSES:
            name = _plain(_text(kind, "DW_AT_name"))
            module = name if name in self._modules else module
        size = self._size_of(kind)
        yield from ((offset + byte, module) for byte in range(size))
        if kind.tag in _CLASSES:
            for child in kind.iter_children():
                if child.tag not in ("DW_TAG_member", "DW_TAG_inheritance"):
                    continue
                place = child.attributes.get("DW_AT_data_member_location")
                member = _type_of(child)
                if member is not None and (place is not None or kind.tag == "DW_TAG_union_type"):
                    at = place.value if place is not None else 0
                    if "DW_AT_bit_size" not in child.attributes and isinstance(at, int):
                        # A base class is a part of the derived class, and is not a separate object
                        # in the list.
                        yield from self._bytes(member, offset + at, module)

    def _resolved(self, die: DIE) -> DIE:
        """Returns the type without typedef, const and volatile. If the file only declares the type,
        and another file contains its definition, returns this definition."""
        while die.tag in _WRAPPERS:
            inner = _type_of(die)
            if inner is None:
                return die
            die = inner
        return self._defined.get(_path(die), die) if "DW_AT_declaration" in die.attributes else die

    def _size_of(self, die: DIE) -> int:
        kind = self._resolved(die)
        if "DW_AT_byte_size" in kind.attributes:
            return int(kind.attributes["DW_AT_byte_size"].value)
        if kind.tag == "DW_TAG_array_type" and (element := _type_of(kind)) is not None:
            return self._count_of(kind) * self._size_of(element)
        return 4 if kind.tag in ("DW_TAG_pointer_type", "DW_TAG_reference_type") else 0

    def _count_of(self, array: DIE) -> int:
        count = 1
        for child in array.iter_children():
            if child.tag == "DW_TAG_subrange_type":
                attributes = child.attributes
                if "DW_AT_count" in attributes:
                    count *= attributes["DW_AT_count"].value
                elif "DW_AT_upper_bound" in attributes and isinstance(
                    attributes["DW_AT_upper_bound"].value, int
                ):
                    count *= attributes["DW_AT_upper_bound"].value + 1
        return count


def _at(items: list[Extent], address: int) -> Extent | None:
    """Returns the item that contains an address. The items are sorted by their addresses."""
    at = bisect.bisect_right(items, address, key=lambda item: item[0]) - 1
    return items[at] if at >= 0 and address < items[at][1] else None


def _children(die: DIE, tags: Iterable[str]) -> Iterator[DIE]:
    """Yields the entries of the given kinds in namespaces, classes and functions."""
    for child in die.iter_children():
        if str(child.tag) in tags:
            yield child
        if child.tag in ("DW_TAG_namespace", "DW_TAG_subprogram", *_CLASSES):
            yield from _children(child, tags)


def _path(die: DIE) -> str:
    """Returns the name of a class with its namespaces and enclosing classes."""
    parent = die.get_parent()
    outer = _path(parent) if parent is not None and parent.tag != "DW_TAG_compile_unit" else ""
    return f"{outer}::{_text(die, 'DW_AT_name')}"


def _text(die: DIE, name: str) -> str:
    attribute: Any = die.attributes.get(name)
    return attribute.value.decode() if attribute is not None else ""


def _plain(name: str) -> str:
    """Returns the name of a class without its template arguments."""
    return re.sub(r"<.*", "", name)


def _type_of(die: DIE) -> DIE | None:
    while "DW_AT_type" not in die.attributes:
        for name in ("DW_AT_specification", "DW_AT_abstract_origin"):
            if name in die.attributes:
                die = die.get_DIE_from_attribute(name)
                break
        else:
            return None
    return die.get_DIE_from_attribute("DW_AT_type")
