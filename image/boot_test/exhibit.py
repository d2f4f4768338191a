"""What a tester learns of the exhibit on a machine: its files, its log, its picture."""
import json

from machine import Failed, until

STATUS = "/run/eddy/status.json"
ANSWER = "/run/eddy/status/config.json"
CONFIG = "/etc/eddy"
ALIKE = 0.5  # words come to less than 0; the tank, the ball and its smoke elsewhere, came to 0.74 and more


# Writes settings without end: each whole, beside its place, then put there.
WRITER = (f"n=$(date +%s); while :; do n=$((n + 1)); printf 'max_force_n = 1.%s\\n' $n >{CONFIG}/conf.d/.n;"
          f" mv {CONFIG}/conf.d/.n {CONFIG}/conf.d/40-n.toml; sync; done")


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
        return self.wait_for_picture(seconds)

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
        """As a careful writer does: beside it, to the disk, then renamed; when that was, by its own clock [s]."""
        said = self.machine.ask(f"cat >{path}.tmp <<'END'\n{text}END\nsync {path}.tmp && cat /proc/uptime && mv {path}.tmp {path}")
        return float(said.split()[0])

    def answer_to(self, path, text, seconds):
        """The exhibit's answer to a file that is written into its settings."""
        def number():
            answer = self.answer()
            return answer["applied"] + answer["refused"]
        before = number()
        self.write(f"{CONFIG}/{path}", text)
        until(f"an answer to {path}", seconds, lambda: number() != before, 0.2)
        return self.answer()

    def answer(self):
        """What it made of its settings."""
        return self.json(ANSWER)

    def wait_for_proof(self, seconds):
        """Settings under which the program dies in their first half minute are given up."""
        until("the settings to be out of probation", seconds, lambda: not self.answer()["probation"], 2.0)

    # --- its log ---
    def count(self, kind, text):
        """How many lines of this kind that hold the text there are since the machine started."""
        return int(self.machine.ask(f"journalctl -b -o cat EDDY_EVENT={kind} | grep -c '{text}' || true", 120).split()[-1])

    def last(self, kind):
        """When it last said something of this kind, since the machine started [s]; -1 if it never did."""
        said = self.machine.ask(f"journalctl -b -n 1 -o json --output-fields=MESSAGE EDDY_EVENT={kind}", 120)
        lines = [line for line in said.splitlines() if line.startswith("{")]
        return int(json.loads(lines[-1])["__MONOTONIC_TIMESTAMP"]) / 1e6 if lines else -1.0

    def process(self):
        return int(self.machine.ask("systemctl show -P MainPID eddy"))
