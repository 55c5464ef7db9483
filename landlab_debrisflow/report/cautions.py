"""Cautions of every report: processes that are not modelled, and numbers that deserve the least trust."""

NOT_MODELLED = (
    "Not modelled are boulders and wood that strike by themselves, the sorting of grains by size (coarse fronts and "
    "levees), the collapse of banks, rain and tributaries during the event, drains, culverts and bridges of a town, "
    "which fill or clog, flow inside buildings, and the breaking or scouring of buildings, dams and walls: they stand."
)

DISTRUST = (
    "Run-out and deposit. They follow from the friction angle and the pore pressure at the start, which nobody "
    "measures before an event: run the scene with the least and the most favourable values that are possible.",
    "The pore pressure of a body that thins. How it follows the load (column: loading_source: overburden, the default, "
    "or proportional) is an open question, and moves the run-out more than most parameters: run both.",
    "The eroded volume. It follows from a growth rate that was fitted to other events and from the depth of erodible "
    "soil, which is a guess almost everywhere.",
    "Pressures on buildings and the flow around them. A structure is a step in the raster, at least three nodes thick; "
    "impact pressures change with the number of particles and have not been shown to converge.",
    "The terrain. A channel narrower than some three nodes, a bridge in the elevation model, or a survey older than "
    "the last event sends the flow another way; arrival times are those of the first centimetre.",
)
