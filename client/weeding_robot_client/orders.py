"""Sends an order in each cycle. Also arms the robot, orders a stop, and sends the final order."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable

from weeding_robot_client.link import Link
from weeding_robot_client.messages import Report
from weeding_robot_client.reasons import inhibited
from weeding_robot_client.script import ACKNOWLEDGE_S, Wish

ORDER_EVERY_S = 0.1  # one control cycle
ORDER_LIFETIME_S = 0.2  # the robot drops an older order
CONNECT_WITHIN_S = 5.0
ARM_WITHIN_S = 5.0
STOP_ORDERS = 3
STOP_EVERY_S = 0.05

Observer = Callable[[Report], None]


class Orders:
    """Sends the present order every ``ORDER_EVERY_S``. The previous order is then still valid."""

    def __init__(self, link: Link, observe: Observer = lambda _report: None) -> None:
        self.link = link
        self.report: Report | None = None
        self._observe = observe
        self._ids = itertools.cycle(range(1, 0x10000))  # 0 means an order of the remote control
        self._due = time.monotonic()

    def send(self, wish: Wish) -> bool:
        """Sends an order immediately."""
        return self.link.send(wish.order(next(self._ids)))

    def service(self, wish: Wish | None, timeout_s: float = 0.02) -> list[Report]:
        """Sends the order if it is due, serves the link for a while, and returns the reports."""
        now = time.monotonic()
        if wish is not None and now >= self._due:
            self._due = max(self._due + ORDER_EVERY_S, now)
            self.send(wish)
        reports = self.link.service(timeout_s)
        for report in reports:
            self.report = report
            self._observe(report)
        return reports

    def hold(self, wish: Wish, seconds: float) -> list[Report]:
        """Repeats an order for the given time. Returns the reports."""
        reports = []
        end = time.monotonic() + seconds
        while (rest := end - time.monotonic()) > 0:
            reports += self.service(wish, min(rest, 0.02))
        return reports

    def stop(self) -> None:
        """Orders a stop several times. The stop therefore arrives even if a frame is lost."""
        wish = Wish(stop=True)
        for _ in range(STOP_ORDERS):
            self.send(wish)
            self.link.service(STOP_EVERY_S)

    def end(self, wish: Wish) -> None:
        """Sends the final order, with all wheels at 0. A stop remains in force."""
        self.send(wish.neutral())
        self.link.service()


def connect(orders: Orders) -> Report | None:
    """Returns the first report, or None if no report arrives in time or the versions differ."""
    end = time.monotonic() + CONNECT_WITHIN_S
    while time.monotonic() < end and orders.link.incompatible is None:
        if reports := orders.service(None):
            return reports[0]
    return None


def not_connected(link: Link) -> str:
    """Returns the reason for the missing connection, and the next action."""
    if link.incompatible:
        return link.incompatible
    if link.unreported:
        return (
            f"The robot on {link.path} answers, but sends no reports. Last reset: "
            f"{link.unreported}. If its light flashes red, the firmware restarts repeatedly."
        )
    return f"No answer on {link.path}. Check the power, the cable and --link."


def arm(
    orders: Orders,
    wish: Wish | None = None,
    progress: Callable[[str], None] = lambda _words: None,
) -> str | None:
    """Sends neutral orders until the robot is armed. Returns None, or the reason for a failure."""
    neutral = (wish or Wish()).neutral()
    reason: str | None = None
    rc_drives = False
    end = time.monotonic() + ARM_WITHIN_S
    while time.monotonic() < end:
        for report in orders.service(neutral):
            if report.ready:
                return None
            obeys = report.order_read and report.inhibit in ("none", "not armed")
            rc_drives = obeys and report.mode == "RC"
            if (words := inhibited(report)) != reason:
                reason = words
                progress(words or "The robot has not read an order of the PC yet.")
        if not orders.link.connected:
            return "The connection was lost. Check cable and power."
    if rc_drives:
        return (
            "The robot reads no order of the PC, because the remote control drives it. Set the "
            "enable switch to 'PC'. In weeding_robot_paper and weeding_robot_warning: switch the "
            "transmitter off."
        )
    return reason or (
        "The robot reads no order of the PC. ./wr monitor shows the source from which the robot "
        "reads orders."
    )


def acknowledge(orders: Orders, wish: Wish | None = None) -> None:
    """Sends neutral orders with the command to acknowledge. They release latched faults."""
    still = (wish or Wish()).neutral()
    orders.hold(Wish(still.wheels, still.steering_degrees, acknowledge=True), ACKNOWLEDGE_S)
