"""Sentences about public values: what is neither class nor function has no docstring that the API could show."""

VALUES = {
    "landlab_debrisflow.__version__": "Version of the package, from its metadata.",
    "landlab_debrisflow.laws.LAWS": "Classes of laws by kind and by the name that chooses them.",
    "landlab_debrisflow.scene.NON_ERODIBLE_BELOW": "Contour of `tsing_shan_valley` below which nothing is eroded [m].",
    "landlab_debrisflow.exact.flows.GRAVITY": "Acceleration of gravity in all solutions [m s-2].",
}
