#!/usr/bin/env python3
"""Commands the robot that `sprung up` runs: command_robot.py home|stand|sit|stop|jump|estop|clear.

Needs PyPI's lcm, and the messages in Python, once: lcm-gen -p lcmtypes/*.lcm --ppath ."""
import hashlib, json, os, random, sys, time
import lcm
from sprung_msgs import operator_command_t, operator_kind_t, operator_outcome_t, operator_reply_t

WORDS = ["home", "stand", "sit", "stop", "jump", "estop", "clear"]
if len(sys.argv) != 2 or sys.argv[1] not in WORDS:
    sys.exit(f"usage: {sys.argv[0]} {'|'.join(WORDS)}")
runtime = os.environ.get("XDG_RUNTIME_DIR")
folder = f"{runtime}/sprung" if runtime else f"/tmp/sprung-{os.getuid()}"
folder = os.environ.get("SPRUNG_RUN_DIR", folder)
if not os.path.exists(f"{folder}/default.json"):
    sys.exit(f"no robot is up ({folder}): sprung up")
run = json.load(open(f"{folder}/default.json"))  # session, time and network of this run
key = open(f"{folder}/default.key", "rb").read()  # its owner alone can read it

network = lcm.LCM(run["lcm_url"])
command = operator_command_t()
command.session = run["session"]
command.utime = time.monotonic_ns() // 1000 - run["epoch_us"]  # more than 2 s old is refused
command.request_id = 1024 * command.utime + random.randrange(1024)
command.apply_at_seq = -1
command.kind = getattr(operator_kind_t, sys.argv[1].upper())
command.jump_count = 1
command.actuator = -1  # home: all of them
command.mac = bytes(16)
content = command.encode()[:-16]  # all but the MAC, which stands at the end
mac = hashlib.blake2b(b"OPERATOR_COMMAND\0" + content, digest_size=16, key=key).digest()


def answered(_channel, data):
    reply = operator_reply_t.decode(data)
    if (reply.session, reply.request_id) != (run["session"], command.request_id):
        return
    if reply.outcome in (operator_outcome_t.ACCEPTED, operator_outcome_t.QUEUED):
        return
    if reply.outcome != operator_outcome_t.DONE:
        sys.exit(f"{sys.argv[1]}: {reply.answered_by} says no: {reply.reason}")
    print(sys.argv[1], "done", reply.reason)
    sys.exit(0)


network.subscribe("OPERATOR_REPLY", answered)
network.publish("OPERATOR_COMMAND", content + mac)
while network.handle_timeout(10_000):
    pass
sys.exit("no answer")
