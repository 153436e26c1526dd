#!/usr/bin/env python3
"""Commands the robot that is up: sprung run -- python3 command_robot.py home|stand|jump|sit|stop|estop|clear"""
import hashlib, lcm, os, sys, time
from sprung_msgs import operator_command_t, operator_kind_t, operator_outcome_t, operator_reply_t

command = operator_command_t()
command.kind = getattr(operator_kind_t, " ".join(sys.argv[1:]).upper(), None) or sys.exit(__doc__)
command.session, command.jump_count = int(os.environ["SPRUNG_SESSION"]), 1
command.apply_at_seq, command.actuator, command.mac = -1, -1, bytes(16)  # at once; home: all of them
command.request_id = command.utime = time.monotonic_ns() // 1000 - int(os.environ["SPRUNG_EPOCH_US"])
content = command.encode()[:-16]  # all but the MAC, which stands at the end
key = os.read(int(os.environ["SPRUNG_KEY_FD"]), 32)
mac = hashlib.blake2b(b"OPERATOR_COMMAND\0" + content, digest_size=16, key=key).digest()
network, replies = lcm.LCM(os.environ["SPRUNG_LCM_URL"]), []
network.subscribe("OPERATOR_REPLY", lambda _channel, data: replies.append(operator_reply_t.decode(data)))
network.publish("OPERATOR_COMMAND", content + mac)
final = {operator_outcome_t.DONE: 0, operator_outcome_t.REFUSED: 1, operator_outcome_t.FAILED: 1}
while network.handle_timeout(10_000):  # ms
    reply = replies.pop()
    if reply.request_id == command.request_id and reply.outcome in final:
        print(f"{reply.answered_by}: {reply.reason or 'done'}")
        sys.exit(final[reply.outcome])
sys.exit("no answer in 10 s")
