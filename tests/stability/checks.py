"""What every scene must pass."""

ENERGY = 2e-3
"""Rise of a body's energy over the kinetic energy it reaches: measured 1e-5 to 4e-4 where the bed is smooth on the
scale of a step, 1.5e-3 over a cliff of 200 m; the error of a step goes with the square of its length."""

STILL = 1e-3
"""Particles that moved by less, over their smoothing length, are not summed again (docs/decisions.md, Flow 5): the
thickness, hence the energy of the pressure, may be older than the speed by so much."""


def assert_sound(scene, energy=ENERGY):
    """Finite, balanced, no particle faster than falls and waves allow, and energy comes from nowhere."""
    watch = scene.watch
    assert watch.finite
    assert scene.imbalance <= 1e-12
    assert watch.excess <= 0.0
    assert watch.gain <= energy * max(watch.kinetic) + STILL * watch.pressure
