"""What is done to the box each time: everything that happens to an exhibit, once."""
import json
import time

from bench import BUTTON, PATIENCE, SETTINGS, STOP, something_drawn
from exhibit import CONFIG, WRITER, Exhibit
from machine import Failed, until

LEFT, RIGHT = "-0.03 -0.02 0.0", "0.03 0.02 0.0"  # where the handle is held [m]
PRESSED = "somebody pressed the button"
CRASH, HANG = ("crashes", "kill -SEGV"), ("hangs", "kill -STOP")


def quick(bench):
    """What no change of the program may break."""
    first_start(bench)
    with bench.machine() as m:
        e = Exhibit(m, bench.expected)
        show(bench, e)
        hand(bench, e)
        button(bench, e)
        settings(bench, e)
        blows(bench, e, CRASH)
        nothing_listens(bench, e)


def each_time(bench):
    first_start(bench)
    with bench.machine() as m:
        e = Exhibit(m, bench.expected)
        show(bench, e)
        hand(bench, e)
        button(bench, e)
        guide(bench, e)
        stop(bench, e)
        stop_and_crash(bench, e)
        closed(bench, e)
        settings(bench, e)
        another_scene(bench, e)
        blows(bench, e, CRASH, HANG)
        nothing_listens(bench, e)
        cut_while_writing(bench, e)
    with bench.machine() as m:
        after_the_cut(bench, Exhibit(m, bench.expected))
    with bench.machine(guest_clock=True) as m:
        by_its_own_clock(bench, Exhibit(m, bench.expected))
    bench.disk.damage("data")
    with bench.machine() as m:
        damaged(bench, m)


def first_start(bench):
    bench.prepare()
    bench.first_start()
    with bench.step("the data partition is sound after that power cut"):
        bench.sound_data("a power cut")


def want_scene(e, title):
    if (scene := e.status()["scene"]) != title:
        raise Failed(f"the scene is {scene}")


def show(bench, e):
    with bench.step("power off and on: the show is on, with these settings", fatal=True) as s:
        e.wait_for_show(PATIENCE)
        s.figure("after the kernel's start [s]", round(e.machine.uptime_s()))
        e.machine.screen("show")
        want_scene(e, "Boot test")
    with bench.step("without a handle the lamps say: it runs, but not with all it should have"):
        bench.want_lamp("amber", "degraded", blinks=True)


def hand(bench, e):
    with bench.step("the handle is plugged in: it is found", fatal=True):
        bench.falcon.tell(f"hold {LEFT}")
        bench.falcon.tell("plug")
        e.wait_for_status("the handle to be ready", lambda s: s["haptics"]["state"] == "ready", PATIENCE)
        bench.want_lamp("green", "a show with a handle")
    with bench.step("the hand moves: the ball on the screen follows, the force comes back") as s:
        left = ball_at(e, "hand_left", lambda column: column < 15.0)
        stir(bench)
        right = ball_at(e, "hand_right", lambda column: column > left + 2.0)
        s.figure("the ball went from column, of 32", round(left, 1))
        s.figure("to", round(right, 1))
        want_force(bench, s)
    with bench.step("the handle is pulled out: that is noticed; plugged in: it is found again"):
        bench.falcon.tell("unplug")
        e.wait_for_status("the handle to be gone", lambda s: s["haptics"]["state"] != "ready", PATIENCE)
        bench.want_lamp("amber", "degraded", blinks=True)
        bench.falcon.tell("plug")
        e.wait_for_status("the handle to be back", lambda s: s["haptics"]["state"] == "ready", PATIENCE)
        bench.want_lamp("green", "a show with a handle")


def button(bench, e):
    with bench.step("the button is pressed: the scene begins anew"):
        before = e.count("reset", PRESSED)
        bench.bridge.tell(f"press {BUTTON} 1000")
        until("the log to say so", PATIENCE, lambda: e.count("reset", PRESSED) > before)


def stop(bench, e):
    with bench.step("the stop is pressed: no force, and it stays so until the button is pressed") as s:
        bench.bridge.tell(f"high {STOP}")
        bench.want_lamp("red", "stopped", blinks=False)
        begin = time.time()
        stir(bench)
        bench.bridge.tell(f"low {STOP}")
        stir(bench)
        if (force := bench.peak_force_n(begin)) > 0:
            raise Failed(f"a force of {force} N after the stop")
        bench.bridge.tell(f"press {BUTTON} 1000")
        bench.want_lamp("green", "a show with a handle")
        want_force(bench, s)


def guide(bench, e):
    with bench.step("the button is held for four seconds: words on the screen; a click: the show again"):
        # It may take a slow machine a while to see that the button is down.
        bench.bridge.tell(f"press {BUTTON} 5000")
        until("words in place of the show", PATIENCE, lambda: not e.picture() and something_drawn(e.machine))
        bench.bridge.tell(f"press {BUTTON} 1000")
        e.wait_for_picture(PATIENCE)


def stop_and_crash(bench, e):
    with bench.step("the program crashes after a stop: no force until the button is pressed") as s:
        bench.bridge.tell(f"high {STOP}")
        bench.want_lamp("red", "stopped", blinks=False)
        bench.bridge.tell(f"low {STOP}")
        said = len(e.machine.said())
        e.machine.ask(f"kill -SEGV {e.process()}")
        e.wait_for_show(PATIENCE, said)
        e.wait_for_status("the handle to be back", lambda s: s["haptics"]["state"] == "ready", PATIENCE)
        bench.want_lamp("red", "stopped")
        begin = time.time()
        stir(bench)
        if (force := bench.peak_force_n(begin)) > 0:
            raise Failed(f"a force of {force} N after the stop")
        bench.bridge.tell(f"press {BUTTON} 1000")
        bench.want_lamp("green", "a show with a handle")
        want_force(bench, s)


def closed(bench, e):
    file = f"{CONFIG}/conf.d/60-hours.toml"
    with bench.step("it closes: a dark screen, no force, and its lamp; it opens: the show again") as s:
        # There is no network to set the clock by: what would tell of that.
        e.machine.ask("mkdir -p /run/systemd/timesync && touch /run/systemd/timesync/synchronized")
        days = ("monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday")
        e.write(file, "[hours]\n" + "".join(f'{day} = "closed"\n' for day in days))
        e.wait_for_status("it to be closed", lambda status: status["exhibit"]["state"] == "closed", PATIENCE)
        until("a dark screen", PATIENCE, lambda: e.machine.screen().is_black())
        time.sleep(2)
        begin = time.time()
        stir(bench)
        if (force := bench.peak_force_n(begin)) > 0:
            raise Failed(f"a force of {force} N in a closed house")
        e.machine.ask(f"rm {file}")
        e.wait_for_picture(PATIENCE)
        want_force(bench, s)


def stir(bench):
    """To and fro; at the end the hand is at the right."""
    for place in (RIGHT, LEFT, RIGHT):
        bench.falcon.tell(f"hold {place}")
        time.sleep(3)


def want_force(bench, step):
    """Fails unless somebody who stirs feels something. A device that answers too late takes the force away until a reset; an emulated
    one on a slow machine does so now and then: the button, and once more."""
    for tries in range(1, 7):
        begin = time.time()
        stir(bench)
        force = bench.peak_force_n(begin)
        if force > 0.02:
            break
        bench.bridge.tell(f"press {BUTTON} 1000")
        time.sleep(5)
    step.figure("largest force [N]", round(force, 3))
    step.figure("tries", tries)
    if not 0.02 < force < 8.0:
        raise Failed(f"the force was {force} N at most")


def ball_at(e, name, right):
    """Where the ball is on the screen, once that is right, of 32 columns."""
    def look():
        column = e.machine.screen(name).column_of_orange()
        return column if column is not None and right(column) else None
    return until("the ball where the hand is", PATIENCE, look)


def settings(bench, e):
    with bench.step("a good file for keys that need no new scene is taken"):
        answer = e.answer_to("conf.d/20-less.toml", "max_force_n = 2.0\n", PATIENCE)
        if answer["result"] != "applied" or answer["source"] != "new":
            raise Failed(f"the answer is {answer}")
    with bench.step("a bad file is refused, with its place; the show goes on"):
        begin = time.time()
        answer = e.answer_to("conf.d/30-bad.toml", "overlay = 7\n", PATIENCE)
        lit, changes = bench.lamps(4, begin)
        if answer["result"] != "refused" or answer["errors"][0]["line"] != 1:
            raise Failed(f"the answer is {answer}")
        if "amber" not in lit or changes < 4:
            raise Failed(f"the lamps did not blink amber: {lit}, {changes} changes")
        e.wait_for_picture(PATIENCE)
        e.machine.ask(f"rm {CONFIG}/conf.d/30-bad.toml")
    with bench.step("a stick while the show is on: its settings are taken, the answer is on the stick"):
        file = bench.out / "15-stick.toml"
        file.write_text("max_force_n = 2.5\n")
        stick, said = bench.stick("while_on", {"eddy/conf.d/15-stick.toml": file}), len(e.machine.said())
        e.machine.plug_stick(stick)
        answer = bench.answer_on(e.machine, stick, said)
        config = json.loads(answer["config.json"])
        if config["result"] != "applied" or config["source"] != "new":
            raise Failed(f"the answer is {config}")
        if json.loads(answer["status.json"])["scene"] != "Boot test":
            raise Failed("status.json is of another scene")


def another_scene(bench, e):
    with bench.step("a file with another scene: the old one runs on until the new one is ready") as s:
        e.write(f"{CONFIG}/another.toml", (SETTINGS / "boot-test.toml").read_text().replace("Boot test", "Another"))
        begin = e.write(f"{CONFIG}/conf.d/20-less.toml", "max_force_n = 2.0\nscene = \"another.toml\"\n")
        def is_another(status):
            if e.machine.screen().is_black():
                raise Failed("the screen was black")
            return status["scene"] == "Another"
        e.wait_for_status("the new scene", is_another, PATIENCE)
        s.figure("on after [s]", round(e.machine.uptime_s() - begin, 1))
        e.wait_for_picture(PATIENCE)
        e.wait_for_proof(PATIENCE)


def blows(bench, e, *each):
    scene = e.status()["scene"]
    for what, blow in each:
        with bench.step(f"the program {what}: the show is back, with its settings and its handle"):
            process, said = e.process(), len(e.machine.said())
            e.machine.ask(f"{blow} {process}")
            e.wait_for_show(PATIENCE, said)
            if e.process() == process:
                raise Failed("it is the same process")
            want_scene(e, scene)
            e.wait_for_status("the handle to be back", lambda s: s["haptics"]["state"] == "ready", PATIENCE)
    with bench.step("of that there is a record"):
        records = e.machine.ask("ls /var/lib/eddy/crash-*.txt").split()
        if len(records) < len(each):
            raise Failed(f"there are only {records}")


def nothing_listens(bench, e):
    with bench.step("the machine has no socket of the network"):
        for line in e.machine.ask("cat /proc/net/tcp /proc/net/tcp6 /proc/net/udp /proc/net/udp6").splitlines():
            if line.split()[0] != "sl":
                raise Failed(f"it has {line}")


def cut_while_writing(bench, e):
    with bench.step("the power goes while settings are written"):
        e.machine.ask(f"({WRITER}) >/dev/null 2>&1 &")
        time.sleep(4)
        e.machine.cut()
        bench.sound_data("a power cut while settings were written")


def after_the_cut(bench, e):
    with bench.step("after that the show comes back by itself, with whole settings") as s:
        e.wait_for_show(PATIENCE)
        s.figure("after the kernel's start [s]", round(e.machine.uptime_s()))
        want_scene(e, "Another")
        if (source := e.answer()["source"]) != "new":
            raise Failed(f"the settings are {source}")
        e.machine.screen("after_the_cut")
        e.machine.ask(f"rm {CONFIG}/conf.d/40-n.toml")
        time.sleep(5)
        e.wait_for_proof(PATIENCE)
    with bench.step("the button is held for ten seconds: the machine switches itself off"):
        bench.bridge.tell(f"press {BUTTON} 12000")
        e.machine.wait_for_off(PATIENCE)


def by_its_own_clock(bench, e):
    """This machine's clock counts instructions, a thousand million a second: what else this computer does changes nothing."""
    m = e.machine
    # One processor in place of two is another renderer to the driver, which prepares its shaders anew.
    with bench.step("by its own clock: from the kernel's start to the show, with shaders to prepare", fatal=True) as s:
        stages_of_a_start(e, s, 0)
    for what, blow in (CRASH, HANG):
        with bench.step(f"by its own clock: the program {what}") as s:
            said, begin = len(m.said()), m.uptime_s()
            m.ask(f"{blow} {e.process()}")
            e.wait_for_show(3 * PATIENCE, said)
            if what == "hangs":
                noticed = m.ask("journalctl -b -o json -u eddy -g 'Watchdog timeout' --output-fields=MESSAGE", PATIENCE)
                at = int(json.loads(noticed.splitlines()[-1])["__MONOTONIC_TIMESTAMP"]) / 1e6
                s.figure("noticed after [s]", round(at - begin, 2), most=10.0)
                begin = at
            s.figure("words again after [s]", round(e.last("first_picture") - begin, 2), most=3.0)
            s.figure("the show again after [s]", round(e.last("ready") - begin, 2))
            want_scene(e, "Another")
    with bench.step("by its own clock: a good file for keys that need no new scene") as s:
        begin = e.write(f"{CONFIG}/conf.d/50-less.toml", "max_force_n = 1.5\n")
        until("the file to be taken", PATIENCE, lambda: e.last("config_taken") > begin, 2.0)
        s.figure("live after [s]", round(e.last("config_taken") - begin, 2), most=1.0)
    with bench.step("by its own clock: the same on another morning") as s:
        said = len(m.said())
        m.may_restart = True
        m.ask("systemctl --no-block reboot")
        stages_of_a_start(e, s, said)


def stages_of_a_start(e, step, said):
    e.wait_for_show(3 * PATIENCE, said)
    for name, command in (("systemd [s]", "show -P UserspaceTimestampMonotonic"),
                          ("the program [s]", "show eddy -P ExecMainStartTimestampMonotonic")):
        step.figure(name, round(int(e.machine.ask(f"systemctl {command}")) / 1e6, 2))
    step.figure("first words [s]", round(e.last("first_picture"), 2))
    step.figure("the show [s]", round(e.last("ready"), 2))


def damaged(bench, m):
    with bench.step("the data partition is overwritten with nonsense: that is said aloud, and there are words on the screen"):
        m.wait_for("made anew, with the factory's configuration and no force|what a new exhibit has is back", PATIENCE)
        until("words on the screen", PATIENCE, lambda: something_drawn(m))
        if "max_force_n = 0.0" not in (text := m.ask(f"cat {CONFIG}/exhibit.toml")):
            raise Failed(f"there may be force though nobody knows of a stop input:\n{text}")
