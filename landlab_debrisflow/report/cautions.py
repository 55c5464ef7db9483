"""Cautions of every report: processes that are not modelled, and numbers that deserve the least trust."""

NOT_MODELLED = (
    "Not modelled are boulders and wood that strike by themselves, the sorting of grains by size (coarse fronts and "
    "levees), the collapse of banks, rain and tributaries during the event, drains, culverts and bridges of a town, "
    "which fill or clog, and flow inside buildings. No building, dam or wall breaks or is scoured."
)

DISTRUST = (
    "Run-out and deposit depend on the friction angle and on the pore pressure at the start. Neither is measured "
    "before an event: run the scene with the least and the most favourable values that are possible.",
    "How the pore pressure follows the load when a body thins (column: loading_source: overburden, the default, or "
    "proportional) is an open question, and moves the run-out more than most parameters: run both. With dilatancy the "
    "permeability takes its place, which is known to orders of magnitude.",
    "The eroded volume follows from a growth rate that was fitted to other events, and from the depth of erodible "
    "soil, which is a guess almost everywhere.",
    "Pressures on buildings, and the flow around buildings, depend on the raster and on the number of particles. A "
    "structure is a step in the raster, at least three nodes thick; impact pressures have not been shown to converge.",
    "Terrain that is not as the raster has it sends the flow another way: a channel narrower than some three nodes, a "
    "bridge, a survey older than the last event. Arrival is the time of the first centimetre.",
)
