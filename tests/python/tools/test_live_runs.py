"""A run of the WebAssembly module is compared with a run of the native virtual board. The
comparison finds each difference."""

from typing import Any

from tools.live_runs import differences


def test_another_byte_is_a_difference() -> None:
    own: dict[str, Any] = {"reports": "a,b\n1,2\n", "events": {"count": 3, "hash": "00"}}
    same = own | {"end": "ended", "failures": ""}
    assert differences(own, same) == []
    assert differences(own, same | {"reports": "a,b\n1,3\n"}) == ["reports"]
    assert differences(own, same | {"events": {"count": 3, "hash": "01"}}) == ["events"]


def test_a_run_that_fails_is_a_difference() -> None:
    own: dict[str, Any] = {"reports": "", "events": {"count": 0, "hash": "00"}}
    assert differences(own, own | {"end": "limit", "failures": "cycle 7\n"}) == [
        "limit",
        "cycle 7",
    ]
