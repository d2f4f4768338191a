"""A PC in QEMU that starts from the image as it is shipped, and what a tester does to it from outside."""
import base64
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import time

from picture import Picture

FIRMWARE = [pathlib.Path("/usr/share/OVMF") / name for name in ("OVMF_CODE_4M.fd", "OVMF_VARS_4M.fd")]

# A shell for the tester, given to the machine by its firmware (SMBIOS), not by its disk: systemd reads units from there.
AGENT = """[Unit]
DefaultDependencies=no
StartLimitIntervalSec=0
[Service]
ExecStart=/bin/sh -c 'until [ -c /dev/vport*p1 ]; do sleep 1; done; exec /bin/sh <>$(echo /dev/vport*p1) >&0 2>&0'
Restart=always
RestartSec=1
"""
WANTED = "[Unit]\nWants=boot-test.service\n"


class Failed(Exception):
    """Something is not as it should be; the text says what."""


def until(what, seconds, look, every=0.5):
    """What look() returns, once that is true; fails after so many seconds."""
    end = time.monotonic() + seconds
    while True:
        found = look()
        if found:
            return found
        if time.monotonic() > end:
            raise Failed(f"waited {seconds:.0f} s in vain for {what}")
        time.sleep(every)


class Disk:
    """A copy of the image that grows as it is written to; the image itself is never touched."""

    def __init__(self, image, path):
        self.path = pathlib.Path(path)
        self.image = pathlib.Path(image).resolve()
        self.path.unlink(missing_ok=True)
        subprocess.run(["qemu-img", "create", "-q", "-f", "qcow2", "-F", "raw", "-b", self.image, self.path], check=True)
        table = json.loads(subprocess.run(["sfdisk", "--json", self.image], check=True, capture_output=True).stdout)
        self.partitions = {p["name"]: (p["start"] * 512, p["size"] * 512) for p in table["partitiontable"]["partitions"]}

    def damage(self, name):
        """Sixteen MiB of nonsense where a partition begins."""
        subprocess.run(["qemu-io", "-c", f"write -q -P 0xaa {self.partitions[name][0]} 16M", self.path], check=True, stdout=subprocess.DEVNULL)

    def read(self, name, to):
        """A partition, as it is now, as a file. Only while the machine is off."""
        whole = self.path.with_suffix(".raw")
        subprocess.run(["qemu-img", "convert", "-f", "qcow2", "-O", "raw", self.path, whole], check=True)
        start, size = self.partitions[name]
        subprocess.run(["dd", f"if={whole}", f"of={to}", "bs=1M", f"skip={start >> 20}", f"count={size >> 20}",
                        "conv=sparse", "status=none"], check=True)
        whole.unlink()


class Machine:
    def __init__(self, disk, out, name, usb, guest_clock):
        """usb: sockets on which devices are served. guest_clock: its clock counts instructions, whatever else this host does."""
        self.out = pathlib.Path(out)
        self.name = name
        self.serial_log = self.out / f"{name}.serial.log"
        self.agent_socket = self.out / "agent.sock"
        self.qmp_socket = self.out / "qmp.sock"
        self.serial_log.unlink(missing_ok=True)
        settings = self.out / "vars.fd"
        if not settings.exists():
            shutil.copy(FIRMWARE[1], settings)
        # No AVX: an emulator is faster at SSE, and QEMU 7.2 reads what a masked gather of AVX2 must not read, which the software
        # rasteriser does not survive.
        command = ["qemu-system-x86_64", "-M", "q35", "-cpu", "Westmere,+rdrand", "-smp", "1" if guest_clock else "2", "-m", "2048"]
        command += ["-accel", "tcg,thread=single" if guest_clock else "tcg,thread=multi"] + (["-icount", "shift=0,sleep=on"] if guest_clock else [])
        command += ["-drive", f"if=pflash,format=raw,readonly=on,file={FIRMWARE[0]}",
                    "-drive", f"if=pflash,format=raw,file={settings}",
                    "-drive", f"file={disk.path},if=virtio,cache=writethrough",
                    "-device", "virtio-gpu-pci,xres=1280,yres=720", "-vga", "none", "-display", "none",
                    "-device", "i6300esb", "-watchdog-action", "reset", "-no-reboot",
                    "-nodefaults", "-nic", "none",
                    "-chardev", f"file,id=serial,path={self.serial_log},append=on", "-serial", "chardev:serial",
                    "-qmp", f"unix:{self.qmp_socket},server=on,wait=off",
                    "-device", "qemu-xhci,id=usb", "-device", "virtio-serial",
                    "-chardev", f"socket,id=agent,path={self.agent_socket},server=on,wait=off",
                    "-device", "virtserialport,chardev=agent"]
        for number, path in enumerate(usb):
            command += ["-chardev", f"socket,id=usb{number},path={path},reconnect=1",
                        "-device", f"usb-redir,chardev=usb{number},bus=usb.0"]
        for credential, text in (("systemd.extra-unit.boot-test.service", AGENT),
                                 ("systemd.unit-dropin.sysinit.target", WANTED)):
            value = base64.b64encode(text.encode()).decode()
            command += ["-smbios", f"type=11,value=io.systemd.credential.binary:{credential}={value}"]
        self.command = command
        self.began = time.monotonic()
        self.log = open(self.out / f"{name}.qemu.log", "wb")
        self.stuck_in = None
        self.may_restart = False  # else it has not to
        self.asked = 0
        self.switch_on()

    def switch_on(self):
        for old in (self.agent_socket, self.qmp_socket):
            old.unlink(missing_ok=True)
        self.qmp_stream = None
        self.process = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log)
        try:
            self.agent_stream = self.connect(self.agent_socket, 20)  # at once: the shell ends while nobody holds the line
        except Failed:
            self.process.kill()
            raise
        if self.stuck_in:
            self.plug_stick(self.stuck_in)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.cut()

    # --- power ---
    def cut(self):
        """Pulls the mains plug: what the guest had not given to the disk is lost."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.hang_up()
        self.log.close()

    def hang_up(self):
        self.agent_stream.close()
        if self.qmp_stream:
            self.qmp_stream.close()

    def wait_for_off(self, seconds):
        until("the machine to switch itself off", seconds, lambda: self.process.poll() is not None)
        if not self.is_off():
            raise Failed(f"it did not switch itself off: see {self.name}.serial.log and {self.name}.qemu.log")

    def is_off(self):
        """QEMU ends in the same way when the machine starts again."""
        return self.process.returncode == 0 and self.said().rstrip().endswith("reboot: Power down")

    def age_s(self):
        return time.monotonic() - self.began

    def uptime_s(self):
        """By its own clock."""
        return float(self.ask("cat /proc/uptime").split()[0])

    def alive(self):
        """A machine that starts again by itself does so from cold: OVMF 2022.11 on two emulated processors sometimes hangs in a warm start."""
        if self.process.poll() is None:
            return
        if self.process.returncode != 0 or self.is_off():
            raise Failed(f"QEMU ended: see {self.name}.qemu.log")
        if not self.may_restart:
            raise Failed(f"the machine started again, which nobody asked for: see {self.name}.serial.log")
        self.hang_up()
        self.switch_on()

    # --- the serial cable ---
    def said(self):
        return self.serial_log.read_text(errors="replace") if self.serial_log.exists() else ""

    def wait_for(self, pattern, seconds, after=0):
        """Where in what was said the pattern ends; only what was said after that many letters counts."""
        def look():
            self.alive()
            found = re.search(pattern, self.said()[after:])
            return found and after + found.end()
        return until(f"'{pattern}' on the serial line of {self.name}", seconds, look)

    # --- QMP: what the monitor and the sockets of the machine show ---
    def qmp(self, command, **arguments):
        if not self.qmp_stream:
            connection = self.connect(self.qmp_socket, 20)
            self.qmp_stream = connection.makefile("rw")
            self.qmp_stream.readline()
            self.qmp("qmp_capabilities")
        self.qmp_stream.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self.qmp_stream.flush()
        while True:
            answer = json.loads(self.qmp_stream.readline() or '{"error": {"desc": "QEMU ended"}}')
            if "error" in answer:
                raise Failed(f"QEMU, {command}: {answer['error']['desc']}")
            if "return" in answer:
                return answer["return"]

    def screen(self, keep_as=None):
        path = self.out / "screen.ppm"
        self.qmp("screendump", filename=str(path))
        if keep_as:
            self.qmp("screendump", filename=str(self.out / f"{keep_as}.png"), format="png")
        return Picture.read(path)

    def plug_stick(self, image):
        self.qmp("blockdev-add", **{"driver": "raw", "node-name": "stick", "file": {"driver": "file", "filename": str(image)}})
        self.qmp("device_add", driver="usb-storage", id="stick", bus="usb.0", drive="stick")
        self.stuck_in = image

    def pull_stick(self):
        self.stuck_in = None
        self.qmp("device_del", id="stick")
        def gone():
            try:
                self.qmp("blockdev-del", **{"node-name": "stick"})
                return True
            except Failed:
                return False
        until("the stick to come out", 20, gone)

    # --- the tester's shell ---
    def connect(self, path, seconds):
        def look():
            if self.process.poll() is not None:
                raise Failed(f"QEMU ended: see {self.name}.qemu.log")
            connection = socket.socket(socket.AF_UNIX)
            try:
                connection.connect(str(path))
                return connection
            except OSError:
                connection.close()
                return None
        return until(path.name, seconds, look, 0.2)

    def ask(self, script, seconds=60):
        """What a shell on the machine, as root, prints for this; fails if its status is not 0."""
        self.asked += 1
        end = f"@@{self.asked}@@"
        self.alive()
        stream = self.agent_stream
        stream.settimeout(1.0)
        try:
            stream.sendall(f"( {script}\n) 2>&1 </dev/null; echo \"{end}$?.\"\n".encode())
        except OSError as error:
            raise Failed(f"nobody listens to: {script}: {error}") from error
        heard, deadline = b"", time.monotonic() + seconds
        while not (found := re.search(re.escape(end).encode() + rb"(\d+)\.\n", heard)):
            self.alive()
            if stream is not self.agent_stream:
                raise Failed(f"the machine started again before it answered to: {script}")
            if time.monotonic() > deadline:
                raise Failed(f"no answer within {seconds} s to: {script}\n{heard.decode(errors='replace')}")
            try:
                heard += stream.recv(65536)
            except TimeoutError:
                pass
            except ConnectionResetError:
                time.sleep(0.1)  # QEMU ends: alive() knows how
        text = heard[:found.start()].decode(errors="replace").replace("\r\n", "\n")
        if found[1] != b"0":
            raise Failed(f"status {found[1].decode()} of: {script}\n{text}")
        return text
