"""CiA 402 (facts canopen 2.1-2.3), typed by hand, and a drive's power states through SDO."""

import time

from canopen.profiles.p402 import State402

from wire import TIMEOUT_S, until

FAULT_RESET = 0x80
MASTER = 0x7F

OFF, READY, ON, ENABLED = "SWITCH ON DISABLED", "READY TO SWITCH ON", "SWITCHED ON", "OPERATION ENABLED"
QUICK_STOP, FAULT = "QUICK STOP ACTIVE", "FAULT"
WAY_TO = {OFF: [0], READY: [0, 6], ON: [0, 6, 7], ENABLED: [0, 6, 7, 15]}

# Typed from facts canopen 2.1: what the low four bits of a control word ask for.
COMMAND = {
    0: "voltage off",
    1: "voltage off",
    2: "quick stop",
    3: "quick stop",
    4: "voltage off",
    5: "voltage off",
    6: "shutdown",
    7: "switch on",
    8: "voltage off",
    9: "voltage off",
    10: "quick stop",
    11: "quick stop",
    12: "voltage off",
    13: "voltage off",
    14: "shutdown",
    15: "enable",
}
# Typed from facts canopen 2.1, transitions 2-12: where each leads; what is not here changes nothing.
NEXT = {
    OFF: {"shutdown": READY},
    # 0x0F holds switch on as well, and goes on: transitions 3 and 4.
    READY: {"switch on": ON, "enable": ENABLED, "quick stop": OFF, "voltage off": OFF},
    ON: {"shutdown": READY, "enable": ENABLED, "quick stop": OFF, "voltage off": OFF},
    ENABLED: {"shutdown": READY, "switch on": ON, "quick stop": QUICK_STOP, "voltage off": OFF},
    FAULT: {},
}
# EPOS2's status words under mask 0x417F (facts canopen 2.2).
# Some last only as long as the drive measures or brakes.
EPOS2_WORDS = {
    "start": 0x0000,
    "not ready": 0x0100,
    OFF: 0x0140,
    READY: 0x0121,
    ON: 0x0123,
    "refresh": 0x4123,
    "measure init": 0x4133,
    ENABLED: 0x0137,
    QUICK_STOP: 0x0117,
    "fault reaction, disabled": 0x010F,
    "fault reaction, enabled": 0x011F,
    FAULT: 0x0108,
}


class BySdo:
    """Power states through SDO alone: each answer is newer than the question."""

    def __init__(self, device):
        self.device = device

    def command(self, word):
        self.device.sdo[0x6040].raw = word

    def state(self):
        word = self.device.sdo[0x6041].raw
        return next(name for name, (mask, bits) in State402.SW_MASK.items() if word & mask == bits)

    def reaches(self, state, timeout_s=TIMEOUT_S):
        return until(lambda: self.state() == state, timeout_s)

    def go(self, state):
        if state == FAULT:
            return self.fail()
        for step, word in enumerate(WAY_TO[state]):
            self.command(word)
            assert self.reaches([OFF, READY, ON, ENABLED][step]), f"{word:#x} led to {self.state()}"
        return None

    def fail(self):
        """A fault without touching the drive's insides: the master's heartbeat ends, and 0x6007 says fault."""
        self.go(ENABLED)
        lose_heartbeat(self.device, 1)
        assert self.reaches(FAULT)

    def settled(self):
        """The state some milliseconds later: all that the drive does at once has been done."""
        time.sleep(0.005)
        return self.state()


def lose_heartbeat(device, option, time_ms=50):
    """One heartbeat of a master, and silence.

    @return the emergency that the device sends then, and when the heartbeat was heard."""
    device.sdo[0x6007].raw = option
    device.sdo[0x1016][1].raw = MASTER << 16 | time_ms
    mark = device.wire.record.mark()
    device.wire.send(0x700 + MASTER, b"\x05")
    emergency = device.wire.record.wait_for_id(0x80 + device.node, mark)
    assert emergency is not None, "no emergency after the master's heartbeat stopped"
    return emergency, device.wire.record.wait_for_id(0x700 + MASTER, mark).timestamp
