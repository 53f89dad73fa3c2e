"""The lidar models of Kurdej's section 4.5 along one beam."""

import plots
from markdown import fixed
from section import Section, select


def _columns(models):
    return [(model, sigma_m) for (model, sigma_m), _ in models.groupby(["model", "sigma_m"],
                                                                      sort=False)]


def _label(model, sigma_m):
    return f"{model}, σ = {sigma_m} m" if model == "imprecise" else model


def _figure(models, column, title):
    drawing, axes = plots.figure(title, "range, m", "mass")
    for number, (model, sigma_m) in enumerate(_columns(models)):
        shown = select(models, model=model, sigma_m=sigma_m)
        axes.step(shown["cell_from_m"], shown[column], where="post", color=plots.COLOURS[number],
                  linestyle=plots.DASHES[number], label=_label(model, sigma_m))
    axes.legend()
    return drawing


def section(data) -> Section:
    models = data["evidential_lidar_models"]
    columns = _columns(models)
    first = select(models, model=columns[0][0], sigma_m=columns[0][1])
    rows = []
    for cell_m in first["cell_from_m"]:
        cells = [select(models, model=model, sigma_m=sigma_m, cell_from_m=cell_m).iloc[0]
                 for model, sigma_m in columns]
        rows.append([f"{fixed(cell_m, 1)} to {fixed(cell_m + 0.5, 1)} m",
                     *(fixed(cell[mass], 3) for mass in ("free", "occupied") for cell in cells)])
    labels = [_label(*column) for column in columns]
    return Section(
        found={"rows": rows, "columns": [f"{mass}: {label}" for mass in ("F", "O")
                                         for label in labels]},
        figures={"lidar_models.svg": _figure(models, "occupied",
                                             "Mass of occupied along one beam with four echoes")})
