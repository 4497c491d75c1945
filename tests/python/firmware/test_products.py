"""The firmware image of each product contains all parts that the product needs, and no other
parts."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import pytest

from tools.firmware import print_products
from tools.image import lock_problems
from tools.sizes import write_products
from traceability.reading.products import (
    DEFAULT,
    DIFFERENT,
    FUNCTIONS,
    HAS,
    PRODUCTS,
    RESULTS,
    image_of,
    intruders,
    listed,
    module_names,
    modules_in,
    modules_of,
    recorded_image_of,
)

ROOT = Path(__file__).parents[3]
# These classes are templates. Suppose that only code for the remote control calls a method of a
# template. This method may then be missing in the firmware images of products without a remote
# control.
INLINED = {"Pipe"}


def held(product: str) -> set[str]:
    elf = ROOT / recorded_image_of(product, ".elf")
    if not elf.exists():
        pytest.fail(f"there is no image of {product}: build it with ./wr firmware")
    return set(modules_in(elf, module_names(ROOT)))


def test_each_product_has_a_composition() -> None:
    for product in listed(ROOT):
        assert (ROOT / product.composition).is_file()


def test_the_modules_in_which_products_differ_exist() -> None:
    assert module_names(ROOT) >= DIFFERENT


def test_some_products_have_a_function_and_other_products_do_not() -> None:
    for having in FUNCTIONS.values():
        assert having
        assert having < PRODUCTS.keys()


@pytest.mark.parametrize("product", PRODUCTS)
def test_an_image_holds_nothing_that_its_product_does_not_need(product: str) -> None:
    assert intruders(held(product), HAS[product]) == set()


@pytest.mark.parametrize("product", PRODUCTS)
def test_an_image_holds_what_its_product_needs(product: str) -> None:
    assert held(product) >= HAS[product]


@pytest.mark.parametrize("product", PRODUCTS)
def test_all_else_is_the_same_in_all_products(product: str) -> None:
    common = held(DEFAULT) - DIFFERENT - INLINED
    assert held(product) - DIFFERENT - INLINED == common
    assert common >= {"MainController", "PC", "PcConnection", "WheelController", "DirController"}


@pytest.mark.parametrize("product", PRODUCTS)
def test_an_intruder_is_found(product: str) -> None:
    """If the firmware image of a product contained a part that it must not have, the check would
    find this part."""
    for module in HAS[product]:
        assert intruders(held(product), HAS[product] - {module}) == {module}


@pytest.mark.parametrize("product", PRODUCTS)
def test_no_product_locks_the_chip(product: str) -> None:
    assert lock_problems((ROOT / image_of(product, ".bin")).read_bytes()) == []


def test_the_sizes_of_the_products_are_those_of_their_images(
    capsys: pytest.CaptureFixture[str],
) -> None:
    wholes = write_products(ROOT)
    print_products(wholes)
    table = capsys.readouterr().out
    records = json.loads((ROOT / RESULTS).read_text(encoding="utf-8"))
    assert records.keys() == PRODUCTS.keys()
    for product, record in records.items():
        words = ["arm-none-eabi-size", str(ROOT / image_of(product, ".elf"))]
        said = subprocess.run(words, check=True, capture_output=True, text=True).stdout
        text, data, bss = map(int, said.splitlines()[1].split()[:3])
        assert record["flash"] == text + data
        copied = record["ram"] - data - bss  # The RAM contains a copy of most of the code.
        assert 0.9 * text < copied < text
        assert 0 < record["stack"] < record["ram"]
        assert set(record["modules"]) == held(product)
        assert re.search(
            rf"^{product} +{text + data} +{record['ram']}  the PC", table, re.MULTILINE
        )


def test_the_modules_of_symbols() -> None:
    listed = """\
00000410 T resetHandler
00002a94 T wr::RC::read(wr::MainController&)
00006e5c V vtable for wr::WaitingK
20000010 b guard variable for wr::(anonymous namespace)::director
00001234 W wr::Pipe<wr::Quantity<wr::VelocityUnit> >::write(wr::Bluetooth const&)
         U memcpy
00000100 t wr::SteeringDevice::turn(wr::Quantity<wr::X>) [clone .part.0]
20001000 B wr::platform::redLight
00000200 t non-virtual thunk to wr::Reverse::reset()
"""
    found = modules_of(listed)
    assert found == {"RC", "WaitingK", "Pipe", "SteeringDevice", "Reverse", "platform"}
