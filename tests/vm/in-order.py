"""in-order.py SENT CANDUMP: whether every line `INTERFACE ID#DATA` of SENT is in candump's log of that interface, in that order."""
import collections
import sys

logged = collections.defaultdict(list)
for line in open(sys.argv[2]):
    logged[line.split()[1]].append(line.split()[2])
sent = collections.defaultdict(list)
for line in open(sys.argv[1]):
    interface, frame = line.split()
    sent[interface].append(frame)
missing = 0
for interface, frames in sorted(sent.items()):
    rest = iter(logged[interface])
    found = sum(1 for frame in frames if any(frame == seen for seen in rest))
    print(f"{interface}: {found} of {len(frames)} sent frames in order among {len(logged[interface])} of candump")
    missing += len(frames) - found
sys.exit(1 if missing or len(sent) != 4 else 0)
