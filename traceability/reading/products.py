"""Reads the products, which are variants of the robot. Each product has a firmware image. CMake
builds this firmware image from a composition."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from traceability.reading.programs import output_of
from traceability.reading.results import read_image, read_record
from traceability.schema import ProductImage
from traceability.sources import DESIGN, SRC, files_below

DEFAULT = "weeding_robot"
# the product without extensions: it has the design of the paper, with the deviations from it
PAPER = "weeding_robot_paper"
CALLS_SUFFIX = "_calls"  # suffix of the name of a firmware image for recordings
RECORDED = PAPER + CALLS_SUFFIX  # firmware image in which the executed lines are recorded
LIST = Path("design/products.toml")


@dataclass(frozen=True)
class Product:
    """A product, with its composition and with the modules that it contains in addition to the
    robot of the paper."""

    name: str
    commands: str
    composition: str
    text: str
    has: frozenset[str]


def listed(root: Path) -> list[Product]:
    """Returns the products in the order of design/products.toml."""
    table = tomllib.loads((root / LIST).read_text(encoding="utf-8"))
    parts = table["parts"]
    return [
        Product(
            item["name"],
            item["commands"],
            item["composition"],
            item["text"],
            frozenset(item["modules"]).union(*(parts[part] for part in item["parts"])),
        )
        for item in table["product"]
    ]


_ROOT = Path(__file__).parents[2]
_LISTED = listed(_ROOT)
# function that a user sees -> the products that contain the module of this function
FUNCTIONS = {
    function: frozenset(product.name for product in _LISTED if module in product.has)
    for function, module in tomllib.loads((_ROOT / LIST).read_text("utf-8"))["functions"].items()
}
PRODUCTS = {product.name: product.commands for product in _LISTED}
HAS = {product.name: set(product.has) for product in _LISTED}
DIFFERENT = set().union(*HAS.values())
# file of each composition -> product
COMPOSITIONS = {product.composition: product.name for product in _LISTED}
_EXTENSION = next(
    Path(file).parent.parent for file, product in COMPOSITIONS.items() if product == DEFAULT
)
RESULTS = Path("build/results/products.json")  # file with the contents of each firmware image

# Matches a symbol that belongs to a class of the project: a method, a static object, or the virtual
# method table of the class.
SYMBOL = re.compile(r"[0-9a-f ]+ \w (?:[a-z-]+(?: [a-z]+)? (?:for|to) )?wr::(\w+)")


def intruders(modules: Iterable[str], has: set[str]) -> set[str]:
    """Returns those modules in a firmware image that belong only to other products."""
    return (set(modules) & DIFFERENT) - has


def image_of(product: str, suffix: str) -> Path:
    """Returns the path of the firmware image that is released. The same firmware image is flashed,
    measured and tested."""
    return Path("build/k64") / f"{product}{suffix}"


def recorded_image_of(product: str, suffix: str) -> Path:
    """Returns the path of the firmware image for recordings. It is built from the same sources as
    the released firmware image, but the compiler inlines fewer functions, because an inlined call
    cannot be recorded."""
    return Path("build/k64_calls") / f"{product}{suffix}"


def module_names(root: Path) -> set[str]:
    """Returns the names of the design modules: the names of all headers that contain a @secret."""
    headers = files_below(root, DESIGN, (".hpp",))
    return {path.stem for path in headers if "@secret" in path.read_text(encoding="utf-8")}


def modules_in(elf: Path, modules: Iterable[str]) -> list[str]:
    """Returns those modules of the list that are in a firmware image. A module is in the image if
    the image has a symbol of its code or of its constants."""
    listed = output_of("arm-none-eabi-nm", "--demangle", elf)
    return sorted(modules_of(listed).intersection(modules))


def modules_of(listed: str) -> set[str]:
    """Returns the classes of the project to which the symbols in a list belong."""
    return {match[1] for match in map(SYMBOL.match, listed.splitlines()) if match}


def read_products(root: Path) -> dict[str, ProductImage] | None:
    """Returns the firmware image of each product. Returns None if the images were not built from
    the present sources."""
    images = read_record(root / RESULTS, dict[str, ProductImage])
    fresh = images is not None and set(images) == set(PRODUCTS) and read_image(root) is not None
    return images if fresh else None


def is_of_default(file: str) -> bool:
    """Returns whether a source is in src or in the extension of the product ``DEFAULT``, and is not
    the composition of another product of this extension."""
    extended = Path(file).is_relative_to(_EXTENSION)
    return file.startswith(f"{SRC}/") or (extended and COMPOSITIONS.get(file, DEFAULT) == DEFAULT)
