"""python-canopen's network with a record of every frame, and waits that end with what they waited for."""

import copy
import threading
import time

import can
import canopen
from can.interfaces.udp_multicast import UdpMulticastBus

TIMEOUT_S = 10.0  # a shared machine stalls now and then; nothing waits that long where all is well
canopen.sdo.SdoClient.RESPONSE_TIMEOUT = TIMEOUT_S


class OneWayBus(UdpMulticastBus):
    """udp_multicast hands a sender its own frames, as no CAN does; python-canopen would take them for news.
    Sprung sends from other ports than the bus's, python-can from it."""

    def __init__(self, record, **arguments):
        super().__init__(**arguments)
        self._record = record
        receive = self._multicast.recv

        def receive_from_others(timeout=None):
            found = receive(timeout)
            return None if found is None or found[1][1] == self._multicast.port else found

        self._multicast.recv = receive_from_others

    def send(self, msg, timeout=None):
        kept = _own_copy(msg)
        kept.timestamp = time.time()
        self._record.on_message_received(kept)
        super().send(msg, timeout)


class Record(can.Listener):
    """Every frame of the bus; our own too on udp_multicast, before they leave."""

    def __init__(self):
        self._news = threading.Condition()
        self._frames = []

    def on_message_received(self, msg):
        with self._news:
            self._frames.append(_own_copy(msg))
            self._news.notify_all()

    def mark(self):
        with self._news:
            return len(self._frames)

    def since(self, mark, can_id=None):
        with self._news:
            return [f for f in self._frames[mark:] if can_id is None or f.arbitration_id == can_id]

    def wait_for(self, wanted, mark=0, timeout_s=TIMEOUT_S):
        """@return the first frame since the mark for which wanted(frame) holds, else None."""
        end = time.monotonic() + timeout_s
        at = mark
        with self._news:
            while True:
                for frame in self._frames[at:]:
                    if wanted(frame):
                        return frame
                at = len(self._frames)
                left = end - time.monotonic()
                if left <= 0 or (not self._news.wait(left) and at == len(self._frames)):
                    return None

    def wait_for_id(self, can_id, mark=0, timeout_s=TIMEOUT_S):
        return self.wait_for(
            lambda frame: frame.arbitration_id == can_id and not frame.is_remote_frame, mark, timeout_s
        )


def _own_copy(msg):
    """python-canopen writes into the data that it received."""
    kept = copy.copy(msg)
    kept.data = bytes(msg.data)
    return kept


class Wire:
    """One CAN bus. `network` is python-canopen's; `record` holds all frames."""

    def __init__(self, arguments):
        self.record = Record()
        on_udp = arguments["interface"] == "udp_multicast"
        settings = {key: value for key, value in arguments.items() if key != "interface"}
        bus = OneWayBus(self.record, **settings) if on_udp else can.Bus(**arguments)
        self.network = canopen.Network(bus)
        self.network.listeners.insert(0, self.record)
        self.network.connect()

    def close(self):
        self.network.disconnect()

    def send(self, can_id, data=b"", remote=False):
        self.network.send_message(can_id, bytes(data), remote)

    def sync(self):
        self.send(0x80)

    def ask(self, can_id, data, answer_id):
        """Sends a frame and returns the data of the first answer under `answer_id`, None where none comes."""
        mark = self.record.mark()
        self.send(can_id, data)
        answer = self.record.wait_for_id(answer_id, mark)
        return None if answer is None else bytes(answer.data)


def until(condition, timeout_s=TIMEOUT_S):
    """Polls. @return what the condition returned in the end."""
    end = time.monotonic() + timeout_s
    while True:
        result = condition()
        if result or time.monotonic() > end:
            return result
        time.sleep(0.005)
