"""Other threads go on while Bagnold simulates, and Ctrl-C ends it."""

import os
import signal
import threading
import time

import bagnold
import pytest

LONG = {"vary": {"slope_angle": [24.0]}, "resolution": 60}


@pytest.fixture
def heard():
    """Ctrl-C is heard, also where the tests were started in the background with SIGINT ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_other_threads_go_on_and_an_interrupted_run_goes_on_later(heard):
    counted = 0
    done = threading.Event()

    def count():
        nonlocal counted
        while not done.wait(0.01):
            counted += 1

    def interrupt():
        time.sleep(3.0)
        os.kill(os.getpid(), signal.SIGINT)

    threads = [threading.Thread(target=count), threading.Thread(target=interrupt)]
    for thread in threads:
        thread.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        bagnold.run("bagnold", only="slope_angle=24,start=rest", **LONG)
    took = time.monotonic() - begin
    done.set()
    for thread in threads:
        thread.join()
    assert took < 20, f"it took {took} s to end"
    assert counted > 20, "the interpreter was free"
    checkpoints = [file for _, _, files in os.walk(os.environ["BAGNOLD_STORE"]) for file in files if file.endswith("checkpoint")]
    assert checkpoints, "what was computed is kept"
    # the interruption is over: the next run is not ended by it
    cheap = {"vary": {"resolution": [10]}}
    assert bagnold.run("film", **cheap, fresh=True).passes
