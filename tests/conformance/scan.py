"""Looks at every object of a device through python-canopen's SDO client, and says what is not as expected."""

import canopen
from canopen import SdoAbortedError, SdoCommunicationError

NO_OBJECT, NO_SUB = 0x06020000, 0x06090011
WRITE_ONLY, READ_ONLY = 0x06010001, 0x06010002
TOO_LONG, TOO_SHORT = 0x06070012, 0x06070013
TOO_HIGH, TOO_LOW = 0x06090031, 0x06090032
NOT_MAPPABLE = 0x06040041
PDO_INVALID = 1 << 31
HISTORY = 0x1003


class Difference:
    """`check` names the question that was asked; known differences are looked up by object and check."""

    def __init__(self, wanted, check, expected, found):
        self.key = (wanted.index, wanted.sub, check)
        self.line = f"{wanted}: {check}: expected {expected}, found {found}"


def outcome(code):
    return "no abort" if code == 0 else "no answer" if code is None else f"abort {code:08X}"


class Scanner:
    def __init__(self, wire, node):
        self._network = wire.network
        # With an empty dictionary python-canopen hands over what came, not what it thinks should have come.
        self._sdo = canopen.sdo.SdoClient(0x600 + node, 0x580 + node, canopen.ObjectDictionary())
        self._sdo.network = wire.network
        wire.network.subscribe(self._sdo.tx_cobid, self._sdo.on_response)
        self.differences = []
        self.transfers = 0
        self._last_maps = {}

    def close(self):
        self._network.unsubscribe(self._sdo.tx_cobid, self._sdo.on_response)

    def read(self, index, sub):
        """@return (abort code or 0, data)."""
        self.transfers += 1
        try:
            return 0, self._sdo.upload(index, sub)
        except SdoAbortedError as error:
            return error.code, b""
        except SdoCommunicationError:
            return None, b""

    def write(self, index, sub, data):
        """@return abort code or 0."""
        self.transfers += 1
        try:
            self._sdo.download(index, sub, data)
        except SdoAbortedError as error:
            return error.code
        except SdoCommunicationError:
            return None
        return 0

    def _expect(self, wanted, check, expected, found, show=outcome):
        if expected != found:
            self.differences.append(Difference(wanted, check, show(expected), show(found)))

    # Reading.

    def look(self, wanted, compare_default):
        """Readable, of the right length, with the right value."""
        code, data = self.read(wanted.index, wanted.sub)
        if wanted.access == "wo":
            return self._expect(wanted, "read of write-only", WRITE_ONLY, code)
        self._expect(wanted, "read", 0, code)
        if code != 0 or wanted.text:
            return self._look_at_text(wanted, data, compare_default) if code == 0 else None
        self._expect(wanted, "length", wanted.size, len(data), str)
        value = wanted.decode(data)
        if wanted.default is not None and compare_default:
            self._expect(wanted, "default", wanted.default, value, str)
        if wanted.index == HISTORY:
            return None  # its limits are for writing: only 0 clears it
        low = value if wanted.low is None else wanted.low
        high = value if wanted.high is None else wanted.high
        return self._expect(wanted, "value in its limits", True, low <= value <= high, str)

    def _look_at_text(self, wanted, data, compare_default):
        if wanted.type == "visible string" and wanted.default is not None and compare_default:
            self._expect(wanted, "default", wanted.default, data.decode("latin-1"), str)

    def look_beside(self, objects):
        """No object and no sub-index beside those that are known."""
        indexes = {index for index, _ in objects}
        for index in sorted(
            {i for known in indexes for i in (known - 1, known + 1) if 0x1000 <= i <= 0xFFFF}
        ):
            if index not in indexes:
                wanted = _Absent(index, 0)
                self._expect(wanted, "absent index", NO_OBJECT, self.read(index, 0)[0])
        for index in sorted(indexes):
            subs = {sub for i, sub in objects if i == index}
            for sub in range(min(max(subs) + 2, 256)):
                if sub not in subs:
                    self._expect(_Absent(index, sub), "absent sub-index", NO_SUB, self.read(index, sub)[0])

    # Writing: for a device that may be changed, with every PDO invalid.

    def silence_pdos(self, objects):
        for index in [i for i, sub in objects if sub == 1 and (i & ~0x3) in (0x1400, 0x1800)]:
            _, data = self.read(index, 1)
            self.write(index, 1, (int.from_bytes(data, "little") | PDO_INVALID).to_bytes(4, "little"))
            self.write(index + 0x200, 0, b"\0")
            self._last_maps["R" if index < 0x1800 else "T"] = index + 0x200

    def touch(self, wanted, order):
        """Access, lengths and limits by writing.

        @param order its values are commands: they are not written back."""
        if wanted.text:
            if wanted.access in ("ro", "const"):
                self._expect(wanted, "write of read-only", READ_ONLY, self._put(wanted, b"text"))
            return
        _, before = self.read(wanted.index, wanted.sub)
        data = before or bytes(wanted.size)
        if wanted.access in ("ro", "const"):
            return self._expect(wanted, "write of read-only", READ_ONLY, self._put(wanted, data))
        if not order:
            self._expect(wanted, "write back", 0, self._put(wanted, data))
        self._expect(wanted, "too long", TOO_LONG, self._put(wanted, data + b"\0"))
        if wanted.size > 1:
            self._expect(wanted, "too short", TOO_SHORT, self._put(wanted, data[:-1]))
        self._touch_limits(wanted)
        if wanted.access == "rw":
            self._expect(
                wanted, "kept by refused writes", before, self.read(wanted.index, wanted.sub)[1], bytes.hex
            )

    def _put(self, wanted, data):
        return self.write(wanted.index, wanted.sub, data)

    def _touch_limits(self, wanted):
        for limit, beyond, code in ((wanted.low, -1, TOO_LOW), (wanted.high, 1, TOO_HIGH)):
            if limit is not None and wanted.representable(limit + beyond):
                found = self._put(wanted, wanted.encode(limit + beyond))
                self._expect(wanted, f"{limit + beyond}, beyond its limit", code, found)

    def map(self, wanted):
        """In which PDOs it may be: tried with the last of each direction, which are invalid and empty."""
        for letter, mapping in self._last_maps.items():
            bits = 0 if wanted.text else 8 * wanted.size
            entry = wanted.index << 16 | wanted.sub << 8 | bits
            code = self.write(mapping, 1, entry.to_bytes(4, "little"))
            expected = 0 if letter in wanted.map else NOT_MAPPABLE
            self._expect(wanted, f"map into {letter}PDO", expected, code)


class _Absent:
    def __init__(self, index, sub):
        self.index, self.sub = index, sub

    def __str__(self):
        return f"{self.index:04X}:{self.sub:02X}"
