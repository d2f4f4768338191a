"""What every test of the box needs: its disk, the machine it starts, the devices that are plugged into it."""
import contextlib
import pathlib
import shutil
import subprocess
import time

from machine import Disk, Failed, Machine, until
from peers import Peer
from picture import Picture
from results import Results

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = TOP / "build" / "release"
PROGRAMS = ("eddy", "tests/redir/redir_falcon", "tests/redir/redir_cp2112")
SETTINGS = TOP / "image" / "boot_test" / "settings"
PATIENCE = 400  # s: a start, in emulation, beside other work; whatever else takes a second or two there has as long

# Lines of the bridge, as settings/exhibit.toml says.
BUTTON, STOP = 0, 1
LAMPS = {"green": 2, "amber": 3, "red": 4}


class Bench(contextlib.ExitStack):
    def __init__(self, image, out, part):
        super().__init__()
        self.out = out
        self.out.mkdir(parents=True, exist_ok=True)
        self.results = Results(out / "results.json", part, {"image": (image / "report.txt").read_text()})
        self.step = self.results.step
        self.disk = Disk(image / "eddy.img", out / "disk.qcow2")
        self.starts = 0
        self.usb = ()

    def machine(self, guest_clock=False):
        """Switched on. With its own clock it has no devices: they live by the clock on the wall."""
        self.starts += 1
        usb = [] if guest_clock else [peer.socket for peer in self.usb]
        return Machine(self.disk, self.out, f"start{self.starts:03}", usb, guest_clock)

    # --- what is plugged in ---
    def plug_in(self):
        """The devices, before the machine is on: the handle is pulled out yet, the stop button not pressed."""
        self.falcon = self.enter_context(Peer(BUILD / "tests/redir/redir_falcon", self.out, "falcon"))
        self.bridge = self.enter_context(Peer(BUILD / "tests/redir/redir_cp2112", self.out, "bridge"))
        self.falcon.tell("unplug")
        self.bridge.tell(f"low {STOP}")
        self.usb = (self.falcon, self.bridge)

    def lamps(self, seconds, begin=None):
        """Which lamps were lit during the next seconds, or since then, and how often any changed."""
        begin = begin or time.time()
        time.sleep(seconds)
        lines = self.bridge.events("lines")
        before = [e for e in lines if e["unix_s"] < begin][-1:]
        during = [e for e in lines if e["unix_s"] >= begin]
        lit = {name for e in before + during for name, line in LAMPS.items() if e["levels"][line] and line in e["driven"]}
        return lit, len(during)

    def want_lamp(self, colour, what, blinks=None):
        """Fails unless this lamp, and no other, is lit at some time in a few seconds, and blinks or does not."""
        def as_wanted():
            lit, changes = self.lamps(4)
            return lit == {colour} and (blinks is None or blinks == (changes > 0))
        until(f"the lamp {colour} for {what}", PATIENCE, as_wanted)

    def peak_force_n(self, since):
        """The largest that arrived at the Falcon; fails if nothing did."""
        seconds = [e for e in self.falcon.events("second", since) if e["exchanges_per_s"] > 0]
        if not seconds:
            raise Failed("nothing was heard at the Falcon")
        return max(e["peak_force_n"] for e in seconds)

    def stick(self, name, files):
        """A stick with the label EDDY-CONFIG and these files {path: file}."""
        image = self.out / f"{name}.stick.img"
        image.unlink(missing_ok=True)
        with open(image, "wb") as f:
            f.truncate((sum(file.stat().st_size for file in files.values()) // (1 << 20) + 48) << 20)
        subprocess.run(["mkfs.vfat", "-n", "EDDY-CONFIG", image], check=True, stdout=subprocess.DEVNULL)
        made = set()
        for path, file in files.items():
            for folder in reversed(pathlib.PurePath(path).parents[:-1]):
                if folder not in made:
                    subprocess.run(["mmd", "-i", image, f"::{folder}"], check=True)
                    made.add(folder)
            subprocess.run(["mcopy", "-i", image, file, f"::{path}"], check=True)
        return image

    def settings_stick(self):
        return self.stick("settings", {f"eddy/{path.relative_to(SETTINGS)}": path for path in SETTINGS.rglob("*.toml")})

    def answer_on(self, m, image, said):
        """What the exhibit wrote to the stick {name: text}, once that can be taken out."""
        m.wait_for("the stick can be taken out", PATIENCE, said)
        m.pull_stick()
        answer = {}
        for name in ("journal.txt", "version.txt", "config.json", "status.json"):
            found = subprocess.run(["mcopy", "-n", "-i", image, f"::eddy-answer/{name}", "-"], capture_output=True)
            if found.returncode == 0:
                answer[name] = found.stdout.decode()
        if not answer.get("journal.txt") or not answer.get("version.txt"):
            raise Failed(f"on the stick there is only {list(answer)}")
        return answer

    # --- what is judged from outside ---
    def make_expected(self):
        """The same scene, drawn by the same program on this machine."""
        scratch = self.out / "expected"
        shutil.rmtree(scratch, ignore_errors=True)
        subprocess.run([BUILD / "eddy", "run", "--scene", SETTINGS / "boot-test.toml", "--clock", "stepped",
                        "--display", "headless", "--haptics", "none", "--seconds", "2", "--fps", "1", "--record", scratch,
                        "--set", "render.width_px=160", "--set", "render.height_px=90"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        frames = sorted(scratch.glob("frame_*.png"))
        shutil.copy(frames[-1], self.out / "expected.png")
        self.expected = Picture.read(self.out / "expected.png")

    def sound_data(self, what):
        """The data partition after a power cut: its journal is played back, and then nothing may be left to mend."""
        partition = self.out / "data.img"
        self.disk.read("data", partition)
        subprocess.run(["e2fsck", "-p", partition], stdout=subprocess.DEVNULL)
        checked = subprocess.run(["e2fsck", "-f", "-n", partition], capture_output=True, text=True)
        if checked.returncode:
            raise Failed(f"data is damaged after {what}: {checked.stdout}")

    # --- what every test begins with ---
    def prepare(self):
        with self.step("the program on this machine draws the picture to expect", fatal=True):
            self.make_expected()
        with self.step("button, lamps and handle answer", fatal=True):
            self.plug_in()

    def first_start(self):
        with self.machine() as m:
            with self.step("power on: there are words on the screen", fatal=True) as s:
                stick = self.settings_stick()
                m.plug_stick(stick)
                until("words on the screen", PATIENCE, lambda: something_drawn(m))
                s.figure("after the kernel's start [s]", round(m.uptime_s()))
            with self.step("a stick at the start: its settings are in place, log and version on the stick", fatal=True):
                self.answer_on(m, stick, 0)


def something_drawn(m):
    """By the exhibit: the firmware, the console and QEMU itself leave the corners black."""
    picture = m.screen("first")
    return picture.blocks()[0] > 2.0 and not picture.is_black()
