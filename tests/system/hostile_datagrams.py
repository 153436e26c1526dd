#!/usr/bin/env python3
"""Sends what LCM never sends, or what it did send, once more; to an LCM network's group and to addresses.

  hostile_datagrams.py GROUP PORT --seed S --count N [--to ADDRESS] [--again FILE]
  hostile_datagrams.py GROUP PORT --listen FILE --count N       keeps what is on the network, for --again
  hostile_datagrams.py GROUP PORT --plain CHANNEL               a well-formed one
  hostile_datagrams.py GROUP PORT --plain CHANNEL --interface NAME --source ADDRESS...   as if from these addresses

Two of the kinds ended every process that received by LCM 1.3.1: a fragment beyond its message, and a channel without an end.
"""

import argparse
import pickle
import random
import socket
import struct
import time


def fragment(seq, size, offset, number, count, rest):
    return b"LC03" + struct.pack(">IIIHH", seq, size, offset, number, count) + rest


def hostile(chance):
    """One of each kind, with random parts."""
    seq = chance.getrandbits(32)
    text = chance.randbytes(chance.randrange(300))
    channel = chance.choice([b"DRIVE_STATE", b"DRIVE_COMMAND", b"JOINT_STATE", b"LEG_COMMAND", b"OPERATOR_COMMAND", b"IMU"])
    yield fragment(seq, 200, 0, 0, 3, channel + b"\0" + bytes(50))
    yield fragment(seq, 200, 0xFFFFFF9C, 1, 3, bytes(100))
    yield fragment(seq, chance.getrandbits(32), chance.getrandbits(32), chance.getrandbits(16), chance.getrandbits(16), text)
    yield fragment(seq, 0xFFFFFFFF, 0, 0, 0xFFFF, channel + b"\0" + text)
    yield b"LC02" + struct.pack(">I", seq) + b"CHANNEL"
    yield b"LC02" + struct.pack(">I", seq) + b"\0" + text
    yield b"LC02" + struct.pack(">I", seq) + channel + b"\0" + text
    yield b"LC02" + struct.pack(">I", seq) + chance.randbytes(20).replace(b"\0", b"x") + b"\0" + text
    yield text
    yield b""


def checksum(head):
    total = sum(struct.unpack(">10H", head))
    return ~((total & 0xFFFF) + (total >> 16)) & 0xFFFF


def frame(group, port, source, datagram):
    """An Ethernet frame to the group, byte by byte: no kernel corrects what it says of its source."""
    address = socket.inet_aton(group)
    udp = struct.pack(">HHHH", 7000, port, 8 + len(datagram), 0) + datagram  # without a checksum
    ends = socket.inet_aton(source) + address
    head = struct.pack(">BBHHHBBH", 0x45, 0, 20 + len(udp), 1, 0, 4, socket.IPPROTO_UDP, 0) + ends
    head = head[:10] + struct.pack(">H", checksum(head)) + head[12:]
    return b"\x01\x00\x5e" + bytes([address[1] & 0x7F]) + address[2:] + bytes(6) + b"\x08\x00" + head + udp


def plain(group, port, channel, interface, sources):
    datagram = b"LC02" + struct.pack(">I", 1) + channel.encode() + b"\0" + bytes(40)
    if not sources:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            out.sendto(datagram, (group, port))
    for source in sources:
        with socket.socket(socket.AF_PACKET, socket.SOCK_RAW) as out:
            out.bind((interface, 0))
            out.send(frame(group, port, source, datagram))


def listen(group, port, count):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as hearing:
        hearing.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        hearing.bind((group, port))
        hearing.setsockopt(
            socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(group) + socket.inet_aton("0.0.0.0")
        )
        hearing.settimeout(20)
        return [hearing.recv(65536) for _ in range(count)]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("group")
    parser.add_argument("port", type=int)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--to", action="append", default=[], help="addresses besides the group")
    parser.add_argument("--again")
    parser.add_argument("--listen")
    parser.add_argument("--plain", metavar="CHANNEL")
    parser.add_argument("--interface")
    parser.add_argument("--source", action="append", default=[])
    asked = parser.parse_args()
    if asked.plain:
        plain(asked.group, asked.port, asked.plain, asked.interface, asked.source)
        return
    if asked.listen:
        with open(asked.listen, "wb") as out:
            pickle.dump(listen(asked.group, asked.port, asked.count), out)
        return
    chance = random.Random(asked.seed)
    kept = []
    if asked.again:
        with open(asked.again, "rb") as file:
            kept = pickle.load(file)
    sent = 0
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 4)
        while sent < asked.count:
            for datagram in [*hostile(chance), *chance.sample(kept, min(5, len(kept)))]:
                for host in [asked.group, *asked.to]:
                    out.sendto(datagram, (host, asked.port))
                sent += 1
            time.sleep(0.002)  # what fills the kernel's buffer costs true messages too; that is not what this is about
    print(f"{sent} datagrams to {1 + len(asked.to)} addresses")


if __name__ == "__main__":
    main()
