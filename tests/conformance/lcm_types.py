"""LCM messages from the .lcm files themselves, by LCM's own rules: nothing of sprung's decoders is in here."""

import collections
import re
import struct

Member = collections.namedtuple("Member", "type name extents")
_NUMBERS = {
    "int8_t": "b", "byte": "B", "boolean": "?", "int16_t": "h", "int32_t": "i", "int64_t": "q", "float": "f", "double": "d",
}  # fmt: skip


def _structs(folder):
    """(name, body without comments) of every struct in the .lcm files of `folder`."""
    for path in sorted(folder.glob("*.lcm")):
        text = re.sub(r"//[^\n]*|/\*.*?\*/", "", path.read_text(), flags=re.S)
        yield from re.findall(r"struct\s+(\w+)\s*{(.*?)}", text, flags=re.S)


def read_constants(folder):
    """{struct name: {constant: integer}} of every .lcm file in `folder`."""
    found = {}
    for name, body in _structs(folder):
        constants = re.findall(r"\bconst\s+int\d+_t\s+(\w+)\s*=\s*(-?\d+)\s*;", body)
        found[name] = {constant: int(value) for constant, value in constants}
    return found


def read_types(folder):
    """{struct name: [Member]} of every .lcm file in `folder`."""
    types = {}
    for name, body in _structs(folder):
        members = re.findall(r"([\w.]+)\s+(\w+)((?:\[\w+\])*)\s*;", re.sub(r"\bconst\b[^;]*;", "", body))
        types[name] = [Member(kind.split(".")[-1], own, re.findall(r"\w+", extents)) for kind, own, extents in members]
    return types


class Decoder:
    """One encoded message: decode() takes all of it, or fails."""

    def __init__(self, types, data):
        self._types, self._data, self._at = types, data, 8  # behind the fingerprint

    def decode(self, name):
        """{member: value}; a list of lists is one list, a list of bytes is bytes."""
        value = self._struct(name)
        assert self._at == len(self._data), "bytes are left over"
        return value

    def _struct(self, name):
        value = {}
        for member in self._types[name]:
            extents = [int(extent) if extent.isdigit() else value[extent] for extent in member.extents]
            value[member.name] = self._member(member, extents)
        return value

    def _member(self, member, extents):
        if not extents:
            return self._element(member.type)
        if member.type == "byte":
            assert len(extents) == 1, "no type of the stack has lists of bytes in lists"
            return self._take(extents[0])
        count = 1
        for extent in extents:
            count *= extent
        return [self._element(member.type) for _ in range(count)]

    def _element(self, kind):
        if kind in _NUMBERS:
            return struct.unpack(">" + _NUMBERS[kind], self._take(struct.calcsize(_NUMBERS[kind])))[0]
        if kind == "string":
            text = self._take(struct.unpack(">i", self._take(4))[0])
            assert text[-1:] == b"\0"
            return text[:-1].decode()
        return self._struct(kind)

    def _take(self, size):
        taken = self._data[self._at : self._at + size]
        assert len(taken) == size, "the message ends too soon"
        self._at += size
        return taken
