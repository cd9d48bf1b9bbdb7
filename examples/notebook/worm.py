"""From a measurement to the named effect: the log of a telescope's autoguider.

`marimo edit worm.py` opens it, `python worm.py` runs it.
"""

import marimo

app = marimo.App(width="medium")


@app.cell
def _():
    from pathlib import Path

    import helixlock
    import marimo as mo
    import matplotlib.pyplot as plt
    import polars as pl

    drive = Path(__file__).parents[1] / "real-worm-drive"
    machine, data = drive / "astro-physics.toml", drive / "performance_dataset03.csv"
    return data, helixlock, machine, mo, pl, plt


@app.cell
def _(mo):
    mo.md(
        """
        # What is wrong with this telescope?

        A mount turns once a sidereal day through a worm. Its autoguider logged how far the star
        strayed, in arc seconds; the machine file knows the gears, and no error of any.
        """
    )


@app.cell
def _(data, helixlock, machine, pl):
    compared = helixlock.compare(machine, data)
    residual, spectrum = pl.DataFrame(compared.residual), pl.DataFrame(compared.spectrum)
    residual
    return compared, residual, spectrum


@app.cell
def _(compared, plt, residual, spectrum):
    figure, (above, below) = plt.subplots(2, 1, figsize=(9, 6), layout="constrained")
    for _pass, rows in residual.group_by("pass", maintain_order=True):
        above.plot(rows["time_s"], rows["residual_arcsec"])
    above.set(xlabel="time in s", ylabel="error in arcsec", title="measured less model")
    below.plot(spectrum["order"], spectrum["amplitude_arcsec"])
    for line in compared["lines"]:
        name = line["name"] or "?"
        below.annotate(name, (line["order"], line["amplitude_arcsec"]))
    below.set(xlabel="order of the axis", ylabel="amplitude in arcsec", title="its spectrum")
    figure
    return


@app.cell
def _(data, helixlock, machine, mo):
    found = helixlock.diagnose(machine, data)
    named = [effect["effect"] for effect in found["effects"] or []]
    mo.md(f"**{found['verdict']}**: {', '.join(named) or 'nothing is named'}")
    return found, named


@app.cell
def _(found, mo, pl):
    parameters = pl.DataFrame(
        [
            {"effect": effect["effect"], "parameter": key, **value}
            for effect in found["effects"] or []
            for key, value in effect["parameters"].items()
        ]
    )
    mo.vstack([parameters, mo.md("What else was tried, and what would tell them apart:")])
    return (parameters,)


@app.cell
def _(found, pl):
    candidates = pl.DataFrame(found["candidates"]).select(
        "effect", "accepted", "rms_arcsec", "p_value", "evidence_behind"
    )
    candidates
    return (candidates,)


@app.cell
def _(found, pl, plt):
    left = pl.DataFrame(found.residual)
    after, axes = plt.subplots(figsize=(9, 3), layout="constrained")
    axes.plot(left["time_s"], left["before_arcsec"], label="the machine file's model")
    axes.plot(left["time_s"], left["after_arcsec"], label="with what was named")
    axes.set(xlabel="time in s", ylabel="error in arcsec")
    axes.legend()
    after
    return


@app.cell
def _(named):
    # The worm of this mount turns once in 382.95 s: order 225 of the axis.
    assert "gear-error" in named, named


if __name__ == "__main__":
    app.run()
