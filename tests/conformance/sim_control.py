"""SIM_CONTROL to the simulated drives, over LCM's own wire format: what is wrong with a drive, by hand."""

import pathlib
import re
import socket
import struct
import urllib.parse

import lcm_types
import programs

_CONSTANTS = lcm_types.read_constants(programs.TOP / "lcmtypes")
_FAULTS = _CONSTANTS["fault_kind_t"]
OVER_CURRENT, UNDER_VOLTAGE = _FAULTS["OVER_CURRENT"], _FAULTS["UNDER_VOLTAGE"]
OVER_TEMPERATURE, MENDED = _FAULTS["OVER_TEMPERATURE"], _FAULTS["NONE"]
_NODE_FAULT = _CONSTANTS["sim_control_kind_t"]["NODE_FAULT"]
_SHORT_MESSAGE = 0x4C433032  # LCM's magic of a message in one datagram: "LC02"


def _type_hash(programs):
    """Of sim_control_t as lcm-gen made it; a type without types in it has its own base hash, rotated."""
    header = pathlib.Path(programs).parent / "lcmtypes/generated/sprung_msgs/sim_control_t.hpp"
    base = int(re.search(r"uint64_t hash = 0x([0-9a-f]+)LL;", header.read_text()).group(1), 16)
    return (base << 1 | base >> 63) & (1 << 64) - 1


class SimControl:
    """Publishes to one session of simulated drives."""

    def __init__(self, programs, lcm_url, session):
        self._hash, self._session, self._count = _type_hash(programs), session, 0
        url = urllib.parse.urlsplit(lcm_url)
        self._to = (url.hostname, url.port)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)

    def fault(self, actuator, kind):
        """Acts at the next cycle."""
        self._count += 1
        message = struct.pack(
            ">Qqqqq6ddbiibd16x",  # without a MAC: the drives were started with --no-key
            *(self._hash, self._session, self._count, self._count, 0, *[0.0] * 6, 0.0),
            *(_NODE_FAULT, actuator, -1, kind, 0.0),
        )
        self._socket.sendto(
            struct.pack(">II", _SHORT_MESSAGE, self._count) + b"SIM_CONTROL\0" + message, self._to
        )

    def close(self):
        self._socket.close()
