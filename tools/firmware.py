"""./wr firmware: builds the firmware for this computer, and the firmware images of all products
for the K64."""

from __future__ import annotations

import argparse
from pathlib import Path

from tools.lock import only_one
from tools.sizes import (
    ELF,
    PARTS,
    Size,
    output,
    place_in_binary,
    total,
    write_products,
    write_sizes,
)
from tools.steps import FailureError
from tools.tasks import FIRMWARE, graph
from traceability.exports.svd import NAME, write_svd
from traceability.reading.products import DEFAULT, PRODUCTS, image_of

SVD = Path("build") / NAME
BIN = image_of(DEFAULT, ".bin")
FILES = {
    ".elf": "for a debugger",
    ".bin": "./wr flash writes this file to the board's drive",
    ".hex": "for other programmers",
    ".map": "addresses that the linker chose",
}


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "firmware",
        description="Builds the firmware for this computer (run it with ./wr sim), and the "
        "firmware images of all products for the K64 (write an image with ./wr "
        "flash). Prints the flash and RAM of each module and of each product.",
    )
    parser.set_defaults(run=lambda root, _options: firmware(root))


def firmware(root: Path) -> int:
    with only_one(root, "firmware"):
        if graph(root).run(FIRMWARE).failed:
            return 1
        print_sizes(write_sizes(root))
        print_products(write_products(root))
        write_svd(root, root / SVD)
    version, build_id = identity(root / ELF, root / BIN)
    print(f"\nversion {version}, build id {build_id}")
    for suffix, use in FILES.items():
        print(f"  {image_of('PRODUCT', suffix)}  {use}")
    print(f"  {SVD}  names of the registers, for a debugger")
    print("For this computer: build/host/sim/weeding_robot_host (./wr sim)")
    return 0


def add_product(parser: argparse.ArgumentParser, does: str) -> None:
    """Adds the option that chooses a product."""
    parser.add_argument(
        "--product", choices=PRODUCTS, default=DEFAULT, help=f"{does} (default: {DEFAULT})"
    )


def print_sizes(sizes: dict[str, Size]) -> None:
    """Prints a table of the modules, with the largest module first. Other parts and the sum
    follow."""
    modules = sorted(sizes.keys() - set(PARTS), key=lambda name: (-sizes[name].flash, name))
    print(f"\n{'bytes of':32} {'flash':>8} {'RAM':>8}")
    for name in [*modules, *(part for part in PARTS if part in sizes)]:
        print(f"{name:32} {sizes[name].flash:8} {sizes[name].ram:8}")
    whole = total(sizes)
    print(f"{'the image':32} {whole.flash:8} {whole.ram:8}")


def print_products(wholes: dict[str, Size]) -> None:
    """Prints a table with the size of each product and its sources of orders."""
    print(f"\n{'product':32} {'flash':>8} {'RAM':>8}  commanded by")
    for product, whole in wholes.items():
        print(f"{product:32} {whole.flash:8} {whole.ram:8}  {PRODUCTS[product]}")


def identity(elf: Path, image: Path) -> tuple[str, str]:
    """Returns the version and the build id, which are in the bytes of the firmware image."""
    for line in output("arm-none-eabi-nm", "--demangle", elf).splitlines():
        address, _, symbol = (*line.split(maxsplit=2), "", "")[:3]
        if symbol == "wr::firmwareIdentity":
            start = place_in_binary(elf, int(address, 16))
            text = image.read_bytes()[start : start + 11]
            return ".".join(map(str, text[:3])), text[3:].decode("ascii", errors="replace")
    raise FailureError(f"{elf.name} contains no version and no build id")
