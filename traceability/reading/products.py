"""The products. Each product is a separate image, which CMake builds from a composition."""

from __future__ import annotations

import re
import subprocess
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from traceability.reading.image_record import read_image
from traceability.reading.results import read_record
from traceability.schema import ProductImage
from traceability.sources import DESIGN, files_below

DEFAULT = "weeding_robot"
PAPER = "weeding_robot_paper"  # only the design of the paper, without safety functions
LIST = Path("design/products.toml")


@dataclass(frozen=True)
class Product:
    """A product with its composition, and with the modules that only it contains."""

    name: str
    commands: str
    composition: str
    text: str
    has: frozenset[str]


def listed(root: Path) -> list[Product]:
    """Returns the products in the order of the list."""
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


_LISTED = listed(Path(__file__).parents[2])
PRODUCTS = {product.name: product.commands for product in _LISTED}
HAS = {product.name: set(product.has) for product in _LISTED}
DIFFERENT = set().union(*HAS.values())
RESULTS = Path("build/results/products.json")  # contents of each image

# A symbol of a class of the project. It is a method, an object of the class, or its table of
# methods.
SYMBOL = re.compile(r"[0-9a-f ]+ \w (?:[a-z-]+(?: [a-z]+)? (?:for|to) )?wr::(\w+)")


def intruders(modules: Iterable[str], has: set[str]) -> set[str]:
    """Returns the modules in an image that the product must not contain."""
    return (set(modules) & DIFFERENT) - has


def image_of(product: str, suffix: str) -> Path:
    """Returns the released image. This image is flashed, measured and tested."""
    return Path("build/k64") / f"{product}{suffix}"


def recorded_image_of(product: str, suffix: str) -> Path:
    """Returns the image of the same sources with less inlining. It allows the recording of each
    call."""
    return Path("build/k64_calls") / f"{product}{suffix}"


def module_names(root: Path) -> set[str]:
    """Returns the design modules. Each module has a header with its name and its secret."""
    headers = files_below(root, DESIGN, (".hpp",))
    return {path.stem for path in headers if "@secret" in path.read_text(encoding="utf-8")}


def modules_in(elf: Path, modules: Iterable[str]) -> list[str]:
    """Returns the modules of this list that are in an image. Their code or constants are among the
    symbols of the image.
    """
    words = ["arm-none-eabi-nm", "--demangle", str(elf)]
    listed = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    return sorted(modules_of(listed).intersection(modules))


def modules_of(listed: str) -> set[str]:
    """Returns the classes of the project in a list of symbols."""
    return {match[1] for match in map(SYMBOL.match, listed.splitlines()) if match}


def read_products(root: Path) -> dict[str, ProductImage] | None:
    """Returns the image of each product, if the present sources built all images."""
    images = read_record(root / RESULTS, dict[str, ProductImage])
    fresh = images is not None and set(images) == set(PRODUCTS) and read_image(root) is not None
    return images if fresh else None
