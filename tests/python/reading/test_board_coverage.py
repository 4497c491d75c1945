"""The source lines of the drivers that were executed on the virtual K64."""

from traceability.reading.board_coverage import lines_executed, stretches

LISTING = """\

build/k64/weeding_robot.elf:     file format elf32-littlearm

Contents of the .debug_line section:

K64Board.cpp:
File name                            Line number    Starting address    View    Stmt

src/k64/K64Board.cpp:
K64Board.cpp                                  37               0x410               x
K64Board.cpp                                  38               0x410       1       x
K64Board.cpp                                  38               0x412       2       x

src/k64/Register.hpp:[++]
Register.hpp                                  74               0x416

/usr/include/array:
array                                          9               0x418

src/k64/K64Board.cpp:
K64Board.cpp                                  40               0x41a       1       x
K64Board.cpp                                   -               0x41c

src/k64/K64Board.cpp:
K64Board.cpp                                  90               0x0                 x
K64Board.cpp                                  91               0x8                 x
K64Board.cpp                                   -               0x500
K64Board.cpp                                  95               0x500               x
K64Board.cpp                                   -               0x502

src/k64/K64Pit.cpp:
K64Pit.cpp                                    12          0x1fff0410               x
K64Pit.cpp                                    13          0x1fff0414               x
K64Pit.cpp                                     -          0x1fff0416
"""


def executed(*bits: int) -> bytes:
    record = bytearray(0x11000)
    for bit in bits:
        record[bit // 8] |= 1 << bit % 8
    return bytes(record)


def test_each_stretch_of_code_belongs_to_one_line() -> None:
    board, register = "src/k64/K64Board.cpp", "src/k64/Register.hpp"
    assert list(stretches(LISTING.splitlines())) == [
        (board, 38, 0x410, 0x412),
        (board, 38, 0x412, 0x416),
        (register, 74, 0x416, 0x418),
        (board, 40, 0x41A, 0x41C),
        (board, 95, 0x500, 0x502),
        ("src/k64/K64Pit.cpp", 12, 0x1FFF0410, 0x1FFF0414),
        ("src/k64/K64Pit.cpp", 13, 0x1FFF0414, 0x1FFF0416),
    ]


def test_a_line_is_executed_when_one_of_its_instructions_is() -> None:
    """The record first contains the 32,768 half-words of the lower RAM, and then the flash."""
    bits = executed(0x412 // 2, 32768 + 0x414 // 2, 32768 + 0x500 // 2)
    assert lines_executed(stretches(LISTING.splitlines()), bits) == {
        "src/k64/K64Board.cpp": {38: True, 40: False, 95: True},
        "src/k64/Register.hpp": {74: False},
        "src/k64/K64Pit.cpp": {12: True, 13: False},
    }
