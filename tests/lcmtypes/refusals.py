"""Commands that nobody may obey, as docs/messages.md has them: none gets a reply, and `sprung status` names each."""

import hashlib
import json
import time

import lcm


def check(robot, place):
    """@param place the folder of its run file and key."""
    import sprung_msgs  # pylint: disable=import-outside-toplevel; generated just now

    run = json.loads((place / "default.json").read_text())
    key = (place / "default.key").read_bytes()
    network, replies = lcm.LCM(run["lcm_url"]), []
    network.subscribe("OPERATOR_REPLY", lambda _, data: replies.append(sprung_msgs.operator_reply_t.decode(data)))

    def send(kind=sprung_msgs.operator_kind_t.SIT, session=run["session"], age_us=0, key=key):
        command = sprung_msgs.operator_command_t()
        command.kind, command.session, command.apply_at_seq, command.mac = kind, session, -1, bytes(16)
        command.request_id = command.utime = time.monotonic_ns() // 1000 - run["epoch_us"] - age_us
        content = command.encode()[:-16]
        mac = hashlib.blake2b(b"OPERATOR_COMMAND\0" + content, digest_size=16, key=key).digest()
        network.publish("OPERATOR_COMMAND", content + mac)
        return content + mac, command.request_id

    def named(what):
        robot.wait_for(lambda: f"OPERATOR_COMMAND refused: {what}" in robot.ask("status").stdout, f"'{what}' in status", 10)

    _, unknown = send(kind=99)
    named("bad value, found 99, expected 0 to 13")
    _, foreign = send(session=run["session"] + 1)
    named("wrong session")
    _, old = send(age_us=3_000_000)
    named("late")
    _, forged = send(key=bytes(32))
    named("forged")
    again, _ = send(kind=sprung_msgs.operator_kind_t.STOP)
    robot.wait_for(lambda: network.handle_timeout(100) > 0, "a reply to what may be obeyed", 10)
    network.publish("OPERATOR_COMMAND", again)
    named("replayed")
    while network.handle_timeout(200):
        pass
    answered = {reply.request_id for reply in replies} & {unknown, foreign, old, forged}
    assert not answered, f"answered, though nobody may be: {answered}"
