"""What a tester learns of the exhibit on a machine: its files, its log, its picture."""
import json

from machine import Failed, until

STATUS = "/run/eddy/status.json"
ANSWER = "/run/eddy/status/config.json"
SETTINGS = "/etc/eddy"
ALIKE = 0.5  # words come to less than 0; the tank, the ball and its smoke elsewhere, came to 0.74 and more


class Exhibit:
    def __init__(self, machine, expected):
        self.machine = machine
        self.expected = expected

    # --- its picture ---
    def picture(self):
        """What is on the screen if it is the tank."""
        picture = self.machine.screen()
        return picture if not picture.is_black() and picture.likeness(self.expected) > ALIKE else None

    def wait_for_picture(self, seconds):
        return until("the picture of the show", seconds, self.picture)

    def wait_for_show(self, seconds, after=0):
        self.machine.wait_for("eddy: the show is on", seconds, after)
        return self.wait_for_picture(60)

    # --- its files ---
    def json(self, path):
        return json.loads(self.machine.ask(f"cat {path}"))

    def status(self):
        return self.json(STATUS)

    def wait_for_status(self, what, right, seconds):
        """The status, once right(status) holds."""
        def look():
            try:
                status = self.status()
            except (Failed, ValueError):  # none yet
                return None
            return status if right(status) else None
        return until(what, seconds, look, 1.0)

    def write(self, path, text):
        """As a careful writer does: beside it, to the disk, then renamed."""
        self.machine.ask(f"cat >{path}.tmp <<'END'\n{text}END\nsync {path}.tmp && mv {path}.tmp {path}")

    def answer_to(self, path, text, seconds):
        """The exhibit's answer to a file that is written into its settings, and how long it took by its own clock [s]."""
        number = self.answers()
        begin = self.machine.uptime_s()
        self.write(f"{SETTINGS}/{path}", text)
        until(f"an answer to {path}", seconds, lambda: self.answers() != number, 0.2)
        return self.json(ANSWER), self.machine.uptime_s() - begin

    def answers(self):
        answer = self.json(ANSWER)
        return answer["applied"] + answer["refused"]

    def source(self):
        """Where the settings that run are from: new, last-good or factory."""
        return self.json(ANSWER)["source"]

    # --- its log ---
    def events(self, kind):
        """Lines of this kind since the machine started: (time since then [s], text)."""
        lines = self.machine.ask(f"journalctl -b -o json --output-fields=MESSAGE EDDY_EVENT={kind}", 120).splitlines()
        found = [json.loads(line) for line in lines if line.startswith("{")]
        return [(int(line["__MONOTONIC_TIMESTAMP"]) / 1e6, line["MESSAGE"]) for line in found]

    def process(self):
        return int(self.machine.ask("systemctl show -P MainPID eddy"))
