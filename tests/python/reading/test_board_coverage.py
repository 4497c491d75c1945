"""The lines of the drivers that were executed on the virtual K64."""

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
"""


def executed(*addresses: int) -> bytes:
    bits = bytearray(0x10000)
    for address in addresses:
        bits[address // 16] |= 1 << address // 2 % 8
    return bytes(bits)


def test_each_stretch_of_code_belongs_to_one_line() -> None:
    board, register = "src/k64/K64Board.cpp", "src/k64/Register.hpp"
    assert list(stretches(LISTING.splitlines())) == [
        (board, 38, 0x410, 0x412),
        (board, 38, 0x412, 0x416),
        (register, 74, 0x416, 0x418),
        (board, 40, 0x41A, 0x41C),
        (board, 95, 0x500, 0x502),
    ]


def test_a_line_is_executed_when_one_of_its_instructions_is() -> None:
    found = lines_executed(stretches(LISTING.splitlines()), executed(0x414, 0x500))
    assert found == {
        "src/k64/K64Board.cpp": {38: True, 40: False, 95: True},
        "src/k64/Register.hpp": {74: False},
    }
