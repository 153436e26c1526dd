"""Nodes made of python-canopen's LocalNode: its SDO server, heartbeat and emergencies. Here is what it leaves
out (facts canopen 7.3): SYNC, PDOs and what may be mapped into them, limits, and for a drive the power states
of CiA 402. Its motor never moves."""

import canopen
from canopen import SdoAbortedError

import objects
from power_states import COMMAND, ENABLED, FAULT, FAULT_RESET, NEXT, OFF, ON, QUICK_STOP, READY

STATUS_WORDS = {OFF: 0x0240, READY: 0x0221, ON: 0x0233, ENABLED: 0x0237, FAULT: 0x0208}
CONTROL, STATUS, MODE, MODE_DISPLAY, POSITION = 0x6040, 0x6041, 0x6060, 0x6061, 0x6064
SAMPLE = 0x2100  # of an encoder card
PDO_INVALID, PDO_ID = 1 << 31, 0x7FF
PDO_BITS = 64
TOO_HIGH, TOO_LOW, STATE = 0x06090031, 0x06090032, 0x08000022
NOT_MAPPABLE, MAP_TOO_LONG = 0x06040041, 0x06040042
RECEIVE_MAPS, TRANSMIT_MAPS = range(0x1600, 0x1604), range(0x1A00, 0x1A04)
SYNC_TYPES = range(1, 241)


class Node:
    """@param dictionary python-canopen's, of this node.
    @param values instead of its defaults, {(index, sub): value}; they outlive a reset."""

    def __init__(self, wire, node, dictionary, values):
        self.node = canopen.LocalNode(node, dictionary)
        self.speaks = True
        self.refuses = {}  # (index, sub): abort code of every write
        self.prepare = lambda node: None  # done after each reset: how this node differs from others
        self._wire, self._values, self._last_events = wire, values, {}
        self.node.add_write_callback(self._check)
        wire.network.add_node(self.node)
        wire.network.subscribe(0x000, self._on_nmt)
        wire.network.subscribe(0x080, self._on_sync)
        for base in (0x200, 0x300, 0x400, 0x500):
            wire.network.subscribe(base + node, self._on_rpdo)
        self._restart()

    def power_up(self):
        """As when the supply comes: all forgotten, boot-up frame, then pre-operational."""
        self.speaks = True
        self._restart()
        self.node.nmt.state = "INITIALISING"
        self.node.nmt.state = "PRE-OPERATIONAL"

    def die(self):
        """The supply goes: no frame any more."""
        self.speaks = False
        self.node.nmt.stop_heartbeat()
        self._restart()
        self.node.nmt.state = "STOPPED"

    def get(self, index, sub=0):
        variable = self.node.object_dictionary.get_variable(index, sub)
        return variable.decode_raw(self.node.get_data(index, sub))

    def put(self, index, value, sub=0):
        variable = self.node.object_dictionary.get_variable(index, sub)
        self.node.data_store.setdefault(index, {})[sub] = variable.encode_raw(value)

    def _restart(self):
        self.node.data_store.clear()
        self.node.nmt.stop_heartbeat()
        for (index, sub), value in self._values.items():
            self.put(index, value, sub)
        self._last_events = {}
        self.prepare(self)

    def _check(self, index, subindex, od, data):
        """What LocalNode does not: limits, mappings, and here the reluctance that a test asks for."""
        if not self.speaks:
            raise SdoAbortedError(STATE)
        if (index, subindex) in self.refuses:
            raise SdoAbortedError(self.refuses[index, subindex])
        value = od.decode_raw(data)
        if od.max is not None and value > od.max:
            raise SdoAbortedError(TOO_HIGH)
        if od.min is not None and value < od.min:
            raise SdoAbortedError(TOO_LOW)
        if index in RECEIVE_MAPS or index in TRANSMIT_MAPS:
            self._check_mapping(index, subindex, value)
        self._written(index, value)

    def _check_mapping(self, index, sub, value):
        """CiA 301's order: the PDO invalid, its count 0, then entries, then the count."""
        if not self.get(index - 0x200, 1) & PDO_INVALID or (sub and self.get(index, 0)):
            raise SdoAbortedError(STATE)
        if sub:
            self._check_entry(value, "R" if index in RECEIVE_MAPS else "T")
        elif sum(self.get(index, n + 1) & 0xFF for n in range(value)) > PDO_BITS:
            raise SdoAbortedError(MAP_TOO_LONG)

    def _check_entry(self, entry, direction):
        od = self.node._find_object(entry >> 16, entry >> 8 & 0xFF)  # or no such object, no such sub-index
        directions = objects.MAP_OF_ACCESS[od.access_type] if od.pdo_mappable else ""
        if direction not in directions or len(od) != entry & 0xFF:
            raise SdoAbortedError(NOT_MAPPABLE)

    def _written(self, index, value):
        pass

    def _on_nmt(self, _can_id, data, _timestamp):
        if data[1] in (0, self.node.id) and data[0] in (0x81, 0x82) and self.speaks:
            self.power_up()

    def _operational(self):
        return self.speaks and self.node.nmt.state == "OPERATIONAL"

    def _maps(self, communication, mapping):
        """@return (COB-ID, type, [(index, sub, bytes)]) of every valid PDO."""
        for number in range(4):
            if communication + number not in self.node.object_dictionary:
                continue
            cob_id = self.get(communication + number, 1)
            if cob_id & PDO_INVALID:
                continue
            entries = [self.get(mapping + number, n + 1) for n in range(self.get(mapping + number, 0))]
            yield (
                cob_id & PDO_ID,
                self.get(communication + number, 2),
                [(entry >> 16, entry >> 8 & 0xFF, (entry & 0xFF) // 8) for entry in entries],
            )

    def _on_rpdo(self, can_id, data, _timestamp):
        if not self._operational():
            return
        for cob_id, _, entries in self._maps(0x1400, 0x1600):
            at = 0
            for index, sub, size in entries if cob_id == can_id else []:
                self.node.set_data(index, sub, bytes(data[at : at + size]))
                at += size
        self._send_pdos(lambda kind: kind not in SYNC_TYPES, only_changes=True)

    def _on_sync(self, _can_id, _data, _timestamp):
        if self._operational():
            self._sample()
            self._send_pdos(lambda kind: kind in SYNC_TYPES, only_changes=False)

    def _sample(self):
        pass

    def _send_pdos(self, wanted, only_changes):
        for cob_id, kind, entries in self._maps(0x1800, 0x1A00):
            data = b"".join(self.node.get_data(index, sub) for index, sub, _ in entries)
            if wanted(kind) and not (only_changes and self._last_events.get(cob_id) == data):
                self._last_events[cob_id] = data
                self._wire.send(cob_id, data)


class Drive(Node):
    def __init__(self, wire, node, dictionary, values):
        self.state = OFF
        super().__init__(wire, node, dictionary, {(CONTROL, 0): 0, (MODE_DISPLAY, 0): 0, **values})

    def fail(self, code):
        self._enter(FAULT)
        self.node.emcy.send(code, 0x03)

    def _restart(self):
        super()._restart()
        self._enter(OFF)

    def _written(self, index, value):
        if index == CONTROL:
            self._control(value)
        if index == MODE:
            self.put(MODE_DISPLAY, value)

    def _control(self, word):
        last = self.get(CONTROL)
        if self.state == FAULT:
            if word & ~last & FAULT_RESET:
                self._enter(OFF)
                self.node.emcy.reset()
        elif not word & FAULT_RESET:
            following = NEXT[self.state].get(COMMAND[word & 0x0F], self.state)
            self._enter(OFF if following == QUICK_STOP else following)

    def _enter(self, state):
        self.state = state
        self.put(STATUS, STATUS_WORDS[state])


class Card(Node):
    """Three 20-bit positions and a counter that goes up with each sample."""

    def __init__(self, wire, node, dictionary, values):
        self.counter = 0
        super().__init__(wire, node, dictionary, values)

    def _sample(self):
        self.counter = (self.counter + 1) % 16
        self.put(SAMPLE, self.counter << 60 | 700_000 << 40 | 600_000 << 20 | 500_000)
