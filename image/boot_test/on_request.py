"""What is done to the box on request, for it takes long: an update, one that does not work; power cuts by the dozen."""
import random
import subprocess
import sys
import time

from bench import PATIENCE, TOP
from exhibit import CONFIG, WRITER, Exhibit
from machine import Failed


def updates(bench):
    bench.prepare()
    bench.first_start()
    update(bench)


def cuts(bench, count, seed):
    bench.prepare()
    bench.first_start()
    with bench.step("power off and on, twice: the show is on; from the second time on its programs are in the cache", fatal=True):
        for _ in range(2):
            with bench.machine() as m:
                Exhibit(m, bench.expected).wait_for_show(PATIENCE)
                show_after_s = m.age_s()
    power_cuts(bench, count, show_after_s + 30.0, random.Random(seed))


def update_stick(bench, name, *options):
    """What a stick carries to make the exhibit another version of itself."""
    folder = bench.out / name
    subprocess.run([TOP / "image/build", "--update-only", "--version", name, "--out", folder, *options],
                   check=True, stdout=subprocess.DEVNULL)
    return bench.stick(name, {f"eddy-update/{path.name}": path for path in (folder / "update").iterdir()})


def update(bench):
    with bench.step("two updates are built, one of them with a program that ends at once", fatal=True):
        broken = bench.out / "overlay" / "usr" / "bin"
        broken.mkdir(parents=True, exist_ok=True)
        (broken / "eddy").write_text("#!/bin/sh\nexit 1\n")
        (broken / "eddy").chmod(0o755)
        good = update_stick(bench, "update-good")
        bad = update_stick(bench, "update-bad", "--overlay", bench.out / "overlay")
    with bench.machine() as m:
        m.may_restart = True
        e = Exhibit(m, bench.expected)
        with bench.step("a stick with an update: the machine starts again with it, and keeps it", fatal=True) as s:
            e.wait_for_show(PATIENCE)
            said = len(m.said())
            m.plug_stick(good)
            m.wait_for("update-good is in place", PATIENCE, said)
            e.wait_for_show(3 * PATIENCE, said)
            m.pull_stick()
            m.wait_for("update-good works and is kept", 3 * PATIENCE, said)
            s.figure("version", version(m))
        with bench.step("an update that does not work: after three starts the machine is what it was") as s:
            said = len(m.said())
            m.plug_stick(bad)
            m.wait_for("update-bad is in place", PATIENCE, said)
            m.pull_stick()
            m.wait_for("the update to update-bad did not work", 20 * PATIENCE, said)
            e.wait_for_show(3 * PATIENCE, said)
            s.figure("version", version(m))
            if version(m) != "update-good":
                raise Failed(f"the version is {version(m)}")
    with bench.step("the data partition is sound after that"):
        bench.sound_data("updates")


def version(m):
    return m.ask("sed -n s/^IMAGE_VERSION=//p /usr/lib/os-release").strip()


def power_cuts(bench, count, longest_s, chance):
    """At random moments from power on to half a minute into the show, while settings are written as soon as there is a place for them.
    A step are ten cuts and a start: what was found of them stays, whatever happens to the rest.

    QEMU 7.2 with two processors now and then runs the breakpoint with which the kernel patches itself, some seconds after its start:
    the kernel panics, and starts again, as it would for any other cause."""
    for first in range(1, count + 1, 10):
        last = min(first + 9, count)
        with bench.step(f"power cuts {first} to {last} at random moments: each time the data is sound; then the show is back") as s:
            bad, shows, panics = [], 0, 0
            for cut in range(first, last + 1):
                said = cut_at(bench, chance.uniform(5.0, longest_s))
                shows += "eddy: the show is on" in said
                panics += "Kernel panic" in said
                try:
                    bench.sound_data(f"cut {cut}")
                except Failed as failed:
                    bad.append(str(failed))
                print(f"     {cut} of {count}; damaged or wrong {len(bad)}", file=sys.stderr, flush=True)
            with bench.machine() as m:
                m.may_restart = True
                e = Exhibit(m, bench.expected)
                e.wait_for_show(PATIENCE)
                panics += "Kernel panic" in m.said()
                s.figure("of them in the show", shows)
                s.figure("damaged", len(bad))
                if panics:
                    s.figure("kernels that panicked and started again", panics)
                s.figure("the show was back after [s]", round(m.age_s()))
                if (source := e.answer()["source"]) != "new":
                    bad.append(f"after cut {last} the settings are {source}")
            if bad:
                raise Failed("\n".join(bad))


def cut_at(bench, moment):
    """A machine is switched on, and its power cut at that second. Returns what it said."""
    with bench.machine() as m:
        m.may_restart = True
        try:
            m.ask(f"(until [ -d {CONFIG}/conf.d ]; do sleep 1; done; {WRITER}) >/dev/null 2>&1 &", max(1.0, moment - m.age_s()))
        except Failed:
            m.alive()  # not yet up: then it is a cut of the start
        time.sleep(max(0.0, moment - m.age_s()))
    return m.said()
