"""Garbage collection while numba compiles."""

import gc
from threading import Event, Thread

import numba
import pytest
from numba.core.event import trigger_event
from numba.extending import overload

import landlab_debrisflow.core.jit  # noqa: F401  (whose listener is tested)


@pytest.fixture(params=[True, False], ids=["on", "off"])
def collects(request):
    """Garbage collection as the user has it before a compilation."""
    before = gc.isenabled()
    (gc.enable if request.param else gc.disable)()
    yield request.param
    (gc.enable if before else gc.disable)()


def compiling():
    """Return what numba does around a compilation."""
    return trigger_event("numba:compile", data={})


def test_off_within_nested_compilations_and_as_before_after_them(collects):
    with compiling():
        with compiling():
            assert not gc.isenabled()
        assert not gc.isenabled()
    assert gc.isenabled() == collects


def test_as_before_after_an_error(collects):
    with pytest.raises(ZeroDivisionError), compiling(), compiling():
        raise ZeroDivisionError
    assert gc.isenabled() == collects


def test_off_until_the_last_thread_has_compiled(collects):
    begun, may_end = Event(), Event()

    def compile_slowly():
        with compiling():
            begun.set()
            may_end.wait(10.0)

    thread = Thread(target=compile_slowly)
    with compiling():
        thread.start()
        assert begun.wait(10.0)
    assert not gc.isenabled()
    may_end.set()
    thread.join()
    assert gc.isenabled() == collects


@pytest.mark.slow
@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
def test_numba_compiles_without_it_and_fails_without_it():
    seen = []

    def seeing(value):
        """Stands for a function that numba looks for while it compiles."""

    @overload(seeing)
    def _compile_seeing(value):
        seen.append(gc.isenabled())
        return (lambda value: value) if isinstance(value, numba.types.Integer) else None

    @numba.njit
    def call(value):
        return seeing(value)

    assert gc.isenabled() and call(3) == 3
    with pytest.raises(numba.core.errors.TypingError):
        call("three")
    assert gc.isenabled() and len(seen) >= 2 and not any(seen)
