"""Long calls: progress, Ctrl-C and other threads; and threads whose floating-point mode is unusable."""

import os
import platform
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest
from conftest import octasphere

from stackless_bvh import Scene


def test_progress_is_told_and_its_errors_end_the_batch(dtype):
    scene, told = Scene(*octasphere(1, dtype)), []
    count = 150_000
    scene.any([0, 0, 0], np.ones((count, 3), dtype), progress=lambda *done: told.append(done))
    assert told == [(65536, count), (131072, count), (count, count)]

    def stop(done, count):
        raise StopIteration(done)

    for ask in (lambda: scene.closest([0, 0, 0], np.ones((count, 3), dtype), progress=stop),
                lambda: scene.contains(np.ones((count, 3), dtype), progress=stop)):  # fmt: skip
        with pytest.raises(StopIteration) as error:
            ask()
        assert error.value.value == 65536


INTERRUPTED = """
import signal, sys, numpy as np
# Jobs in the background of a shell ignore it.
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.path.insert(0, sys.argv[1])
from conftest import octasphere
from stackless_bvh import Scene
scene = Scene(*octasphere(4))
directions = np.broadcast_to(np.float64([0.1, 0.2, 0.3]), (10**8, 3))
print("begun", flush=True)
try:
    scene.closest([0, 0, 0], directions)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(os.name == "nt", reason="no signals")
def test_ctrl_c_ends_a_batch_that_would_take_minutes():
    child = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, os.path.dirname(__file__)], stdout=subprocess.PIPE, text=True
    )
    try:
        assert child.stdout.readline() == "begun\n"
        threading.Event().wait(0.5)
        child.send_signal(signal.SIGINT)
        output, _ = child.communicate(timeout=60)
    finally:
        child.kill()
    assert (output, child.returncode) == ("interrupted\n", 0)


BUILDING = """
import signal, sys, time, numpy as np
signal.signal(signal.SIGINT, signal.default_int_handler)
from stackless_bvh import Scene
vertices = np.random.default_rng(1).random((6_000_000, 3))
faces, told = np.arange(6_000_000).reshape(-1, 3), []
# Print this when the construction has begun.
progress = lambda *done: told.append(done) or len(told) == 5 and print("begun", flush=True)
try:
    Scene(vertices, faces, "best", progress)
except KeyboardInterrupt:
    print("interrupted", all(0 <= done <= count == 2_000_000 for done, count in told), flush=True)
# The remaining work ends at its next check for interrupts. Wait for this, even on a busy machine.
while True:
    used = time.process_time()
    time.sleep(1)
    if time.process_time() - used < 0.05:
        break
print("at rest", flush=True)
"""


@pytest.mark.skipif(os.name == "nt", reason="no signals")
def test_ctrl_c_ends_a_long_build():
    child = subprocess.Popen([sys.executable, "-c", BUILDING], stdout=subprocess.PIPE, text=True)
    try:
        assert child.stdout.readline() == "begun\n"
        child.send_signal(signal.SIGINT)
        output, _ = child.communicate(timeout=100)
    finally:
        child.kill()
    assert (output, child.returncode) == ("interrupted True\nat rest\n", 0)


def test_an_error_of_progress_ends_a_build(dtype):
    def stop(done, count):
        raise LookupError(done, count)

    vertices = np.random.default_rng(1).random((300_000, 3)).astype(dtype)
    with pytest.raises(LookupError) as error:
        Scene(vertices, np.arange(300_000).reshape(-1, 3), "best", stop)
    assert error.value.args[1] == 100_000


FAST_MATH = """
import ctypes, sys, numpy as np
sys.path.insert(0, sys.argv[1])
from conftest import octasphere
from stackless_bvh import Scene
scene, points = Scene(*octasphere(1)), np.ones((5, 3))
ctypes.CDLL(sys.argv[2])
if np.float64(5e-324) * 1.0 + np.float64(5e-324) != 0.0:
    sys.exit("it had no effect")
for ask in (lambda: Scene(*octasphere(1)), lambda: scene.any(points, points), lambda: scene.contains(points)):
    try:
        ask()
    except RuntimeError as error:
        print(error)
"""


def test_a_thread_whose_floats_are_of_no_use_is_refused(tmp_path):
    source, library = tmp_path / "fast.c", tmp_path / "fast.so"
    source.write_text("int nothing;")
    try:
        subprocess.run(["cc", "-shared", "-fPIC", "-ffast-math", source, "-o", library], check=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("no compiler")
    command = [sys.executable, "-c", FAST_MATH, os.path.dirname(__file__), library]
    ran = subprocess.run(command, capture_output=True, text=True)
    if "no effect" in ran.stderr:
        pytest.skip("this compiler does not make such libraries")
    message = "this thread takes subnormal numbers for zero (was a library compiled with -ffast-math?)\n"
    assert (ran.stdout, ran.returncode) == (3 * message, 0), ran.stderr


def test_other_threads_run_while_rays_are_traced():
    scene, ticks, done = Scene(*octasphere(3)), [], threading.Event()
    directions = np.broadcast_to(np.float64([0.1, 0.2, 0.3]), (400_000, 3))

    def tick():
        while not done.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    scene.closest([0, 0, 0], directions)
    done.set()
    thread.join()
    assert len(ticks) > 10


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="this system does not tell its memory")
def test_a_soak_of_some_seconds():
    soak = [sys.executable, os.path.join(os.path.dirname(__file__), "soak.py"), "--minutes", "0.08"]
    ran = subprocess.run(soak, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    assert "memory: not judged" in ran.stdout
