#!/usr/bin/env python3
"""Fails when a datagram of this multicast group comes in at this address within a second.
usage: hear_nothing.py GROUP PORT OWN_ADDRESS"""
import socket
import sys

group, port, own = sys.argv[1], int(sys.argv[2]), sys.argv[3]
listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
listener.bind((group, port))
listener.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(group) + socket.inet_aton(own))
listener.settimeout(1.0)
try:
    data, sender = listener.recvfrom(65536)
except TimeoutError:
    sys.exit(0)
sys.exit(f"heard {len(data)} bytes of the robot's own network from {sender}")
