"""Who may kill a mutant: the unit tests of its room, then the campaign."""

import re
import resource
import signal
import subprocess

import build
import mutants

SEED = 1
PREFIX = re.compile(r"^\s*TEST(?:_F|_P)?\((\w+),", re.MULTILINE)
RUNS = {"single_leg": (20, 10), "pegasus": (5, 5)}  # of a class, and at a time
# Of processor time: some times what the longest takes without a mutant. Whoever waits for ever takes none.
LONGEST_CPU_S, LONGEST_S = 60, 1800
# Whole robots in one process, those that take seconds: what takes minutes is the campaign's part.
WHOLE = "drive_inputs forged_commands homed_robot in_process_links inprocess_robot pegasus_boot pegasus_imu".split()
# Whoever fits recordings, or walks for minutes, watches over nothing.
LEFT_OUT = {"estimator": ("identification",), "planner": ("gait/walk_property", "jump_height")}


def suites_of(files):
    found = set()
    for name in files:
        found |= set(PREFIX.findall((mutants.TOP / name).read_text(encoding="utf-8")))
    return sorted(found)


def filter_of(suites):
    return ":".join(f"{suite}.*:*/{suite}.*" for suite in suites)


def test_files(folder):
    return [name for name in build.names() if name.startswith(folder + "/") and name.endswith("_test.cpp")]


def stages(mutant):
    """(program, filter): the file's own suites, its room, and whole robots in one process."""
    room = mutant.file.split("/")[0]
    own = f"tests/{mutant.file.rsplit('.', 1)[0]}_test.cpp"
    left_out = tuple(f"tests/{room}/{name}" for name in LEFT_OUT.get(room, ()))
    of_room = [name for name in test_files(f"tests/{room}") if not name.startswith(left_out)]
    out = [(f"{room}_tests", filter_of(suites_of([own])))] if own in of_room else []
    out.append((f"{room}_tests", filter_of(suites_of(of_room))))
    if room != "runtime":
        whole = suites_of(f"tests/simulation/in_process/{name}_test.cpp" for name in WHOLE)
        out.append(("simulation_tests", filter_of(whole)))
    return out


def limit_processor_time():
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST_CPU_S, LONGEST_CPU_S))


def called(command, mutant):
    """@return (exit status, output); below 0: it crashed, or did not end."""
    try:
        done = subprocess.run(list(map(str, command)), cwd=build.scratch(), env=build.environment(mutant), check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LONGEST_S,
                              preexec_fn=limit_processor_time)  # fmt: skip
        return done.returncode, done.stdout.decode(errors="replace")
    except subprocess.TimeoutExpired as ended:
        return -1, (ended.stdout or b"").decode(errors="replace")


def failed_case(mutant, program, chosen):
    """The case that fails or does not end; nothing where all pass."""
    command = [build.program(program), f"--gtest_filter={chosen}", "--gtest_fail_fast"]
    code, said = called(command, mutant)
    if code == 0:
        return None
    named = re.findall(r"^\[  FAILED  \] (\S+?)(?:,| \()", said, re.MULTILINE)
    begun = re.findall(r"^\[ RUN      \] (\S+)", said, re.MULTILINE)
    if code in (-1, -signal.SIGXCPU):
        return f"{begun[-1]} does not end"
    return (named or begun[-1:] or [f"{program} status {code}"])[0]


def unit_test(mutant):
    """The case that kills it, twice: what fails once may have failed for another reason."""
    for program, chosen in stages(mutant):
        case = failed_case(mutant, program, chosen)
        if case and (" " in case or failed_case(mutant, program, case)):
            return case
    return None


def campaign_runs(mutant, robot, fault, first, count):
    """Runs that are not as they should be: number -> why. Healthy twins are made without a mutant alone."""
    command = [build.program("sprung"), "campaign", "--robot", robot, "--seed", SEED, "--first", first, "--runs", count]
    command += ["--jobs", 1] + ([] if fault == "any" else ["--only", fault]) + (["--no-twins"] if mutant else [])
    code, said = called(command, mutant)
    if code < 0:
        return {f"{first}": f"the campaign ends with {code}"}
    found = re.findall(r"^(without a fault: )?run (\d+), .*\n +(.*)$", said, re.MULTILINE)
    return {number + (" twin" if twin else ""): why.strip(" ;") for twin, number, why in found}


def campaign(mutant, robot, control):
    """Where and why the campaign sees it; nothing where it does not. @param control (robot, fault, first, count) ->
    runs that are not as they should be without a mutant."""
    runs, at_a_time = RUNS[robot]
    for fault in mutant.campaign:
        for first in range(0, runs, at_a_time):
            chosen = (robot, fault, first, min(at_a_time, runs - first))
            found = campaign_runs(mutant, *chosen)
            new = sorted(set(found) - set(control(*chosen)), key=lambda text: int(text.split()[0]))
            if new:
                return f"{robot} {fault} {new[0]}: {found[new[0]]}"
    return None
