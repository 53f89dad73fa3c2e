"""The map in every scan against the map at the decision."""

from types import SimpleNamespace

import plots
from claims import Claim, Verdict
from markdown import fixed, grouped, percent, scientific
from section import Section, one, select

AGREES_BELOW = 1e-12
PROVEN = ["classical", "conservative", "optimistic"]
OPEN_CONTEXTS = ["none", "road", "intermediate"]
SHOWN_SCANS = [1, 2, 5, 10, 100]
ORDERS = {"every scan": "map in every scan", "decision": "map at the decision"}
DRIVEN = {"every scan": "map in every scan, pignistic", "decision": "map at the decision, pignistic",
          "our decision": "map at the decision, ours"}


def _order_rows(order):
    return [[row.context, row.ageing, row.specialised, row.sets, row.sets_not_kept_by_scan,
             row.sets_not_kept_by_specialisation, row.sets_not_kept_by_ageing,
             fixed(row.added_by_a_scan, 2),
             f"< {scientific(row.difference, 0)}" if row.difference <= AGREES_BELOW
             else fixed(row.difference, 3)] for row in order.itertuples()]


def _ghost_rows(ghost):
    return [[ORDERS[order], fixed(belief, 2),
             *(fixed(one(ghost, "free", map=order, belief=belief, scan=scan), 4)
               for scan in SHOWN_SCANS)] for belief in ghost["belief"].unique()
            for order in ORDERS]


def _ghost_figure(ghost):
    drawing, axes = plots.figure("A mapped house that is not there, seen free", "scan",
                                 "free")
    for number, belief in enumerate(ghost["belief"].unique()):
        for order, dash in zip(ORDERS, plots.DASHES):
            shown = select(ghost, map=order, belief=belief)
            shown = shown[shown["scan"] <= 20]
            axes.plot(shown["scan"], shown["free"], color=plots.COLOURS[number], linestyle=dash,
                      label=f"β = {belief}, {ORDERS[order]}")
    mass = select(ghost, map="decision", belief=ghost["belief"].min())
    mass = mass[mass["scan"] <= 20]
    axes.plot(mass["scan"], mass["free_mass"], color=plots.COLOURS[5], label="mass of free, no map")
    axes.axhline(0.5, color=plots.PAPER, linewidth=1)
    axes.set_ylim(0, 1)
    axes.set_xticks(range(0, 21, 5))
    axes.legend(loc="center right", bbox_to_anchor=(1, 0.72), fontsize=12)
    return drawing


def _drive_rows(drive):
    rows = []
    for name, words in DRIVEN.items():
        shown = select(drive, map=name)
        sums = shown[["points", "free", "mapped", "unknown"]].sum()
        rows.append([words, grouped(sums["points"]),
                     *(percent(sums[column] / sums["points"], 1)
                       for column in ("free", "mapped", "unknown"))])
    return rows


def _share_free(drive, name):
    sums = select(drive, map=name)[["points", "free"]].sum()
    return sums["free"] / sums["points"]


def section(data) -> Section:
    order, ghost = data["evidential_map_order"], data["evidential_ghost"]
    alone, drive = data["evidential_map_alone"], data["evidential_ghost_drive"]
    proven = order[order["context"].isin(OPEN_CONTEXTS) & order["ageing"].isin(PROVEN)]
    agrees = bool((proven["difference"] <= AGREES_BELOW).all())
    kept = proven[["sets_not_kept_by_scan", "sets_not_kept_by_specialisation",
                   "sets_not_kept_by_ageing"]].to_numpy().sum()
    differs = order[order["difference"] > AGREES_BELOW]
    contextual = select(order, ageing="contextual")
    contextual = contextual[contextual["context"].isin(OPEN_CONTEXTS)]
    masses = [one(alone, "mass", belief=0.97, scan=scan) for scan in (1, 2, 3, 20)]
    last = {belief: one(ghost, "free", map="every scan", belief=belief, scan=100)
            for belief in ghost["belief"].unique()}
    claims = [
        Claim("equation 5.2 in 5.3", "β of a road that nobody sees, after 1, 2, 3 scans",
              "0.97, stated once", ", ".join(fixed(mass, 4) for mass in masses[:3]),
              Verdict.DEPARTS, "one map is taken for new evidence in every scan; ours speaks at the "
              "decision"),
        Claim("section 5.1", "what is known of free, occupied and moving", "with the map",
              f"without it, difference below {scientific(proven['difference'].max(), 0)}",
              Verdict.EQUALS) if agrees else
        Claim("section 5.1", "what is known of free, occupied and moving", "with the map",
              "not the same without it", Verdict.DEPARTS, "the table below"),
        Claim("section 4.3.3", "a mapped house that is not there, seen free 100 times, β = 0.97",
              f"by its equations free {fixed(last[0.97], 3)}",
              f"free mass {fixed(one(ghost, 'free_mass', map='decision', belief=0.97, scan=100), 3)}",
              Verdict.DEPARTS, "the map names what is seen and does not overrule it"),
    ]
    return Section(
        found={"orders": _order_rows(order), "agrees": agrees, "kept": int(kept),
               "proven": SimpleNamespace(below=proven["difference"].max(),
                                         rows=len(proven), scans=int(order["scans"].iloc[0])),
               "differs": sorted({f"{row.context}, {row.ageing}" for row in differs.itertuples()
                                  if row.context != "building"}),
               "building_differs": bool((differs["context"] == "building").sum() ==
                                        (order["context"] == "building").sum()),
               "contextual_agrees": bool((contextual["difference"] <= AGREES_BELOW).all()),
               "ghosts": _ghost_rows(ghost),
               "scans": [str(scan) for scan in SHOWN_SCANS],
               "last": last, "alone": masses, "driven": _drive_rows(drive),
               "driven_free": {name: _share_free(drive, name) for name in DRIVEN},
               "late_free": {belief: one(ghost, "free", map="decision", belief=belief, scan=100)
                             for belief in ghost["belief"].unique()},
               "mass": one(ghost, "free_mass", map="decision", belief=0.97, scan=100)},
        claims=claims, figures={"ghost.svg": _ghost_figure(ghost)})
