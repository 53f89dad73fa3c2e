"""One cell of Kurdej's thesis: figures 5.6 and 5.7, and the rates of its table 7.1."""

import plots
from claims import Claim, Verdict
from markdown import fixed
from section import Section, one, select

GAINS = [0.05, 0.15]
PRINTED_STOPS = {0.05: 12, 0.15: 10}  # section 5.4
AGEINGS = ["conservative", "classical", "optimistic", "proportional", "contextual"]
SHOWN_SCANS = [1, 5, 6, 8, 10, 12, 16, 24, 25, 26, 27, 30]
MASSES = ["free", "moving", "movable", "standing", "ignorance", "accumulator"]
NAMES = {"road": ["D", "M", "{M,S}", "S", "Ω", "ζ"],
         "intermediate": ["N", "M", "{M,S,U}", "{S,U}", "Ω", "ζ"]}
COMES, LEAVES = 6, 25  # scans


def _figure(curves, context, gain):
    place = "road" if context == "road" else "intermediate space"
    drawing, axes = plots.figure(f"A cell of {place} that is taken and left, δ = {gain}",
                                 "scan", "mass")
    shown = select(curves, context=context, gain=gain)
    for number, (column, name) in enumerate(zip(MASSES, NAMES[context])):
        axes.plot(shown["scan"], shown[column], color=plots.COLOURS[number],
                  linestyle=plots.DASHES[number], label=name)
    axes.axvspan(COMES - 0.5, LEAVES - 0.5, color="#EEEEEE", zorder=0)
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    return drawing


def _stop(stops, **where):
    return int(one(stops, "scan", **where))


def _largest_difference_of_contexts(curves):
    road, beside = (select(curves, context=context) for context in ("road", "intermediate"))
    return max((road[column].to_numpy() - beside[column].to_numpy()).max() for column in MASSES)


def _claims(curves, stops):
    claims = []
    for gain, printed in PRINTED_STOPS.items():
        found = _stop(stops, context="road", ageing="conservative", rates="exchanged", gain=gain)
        claims.append(Claim("section 5.4, figure 5.6", f"stopped overtakes moving, δ = {gain}",
                            f"scan {printed}", f"scan {found}",
                            *((Verdict.EQUALS,) if found == printed else
                              (Verdict.FALLS_SHORT, "the table below"))))
    wrong = _stop(stops, context="road", ageing="conservative", rates="as printed", gain=0.05)
    claims.append(Claim("table 7.1", "rates of {D,N,M} and {I,S,U}", "0.01 and 0.10",
                        "0.10 and 0.01", Verdict.DEPARTS,
                        f"with those printed stopped overtakes moving in scan {wrong}, not "
                        f"{PRINTED_STOPS[0.05]}; they are of contextual discounting, which hits "
                        "the complement"))
    for context, figure in (("road", "5.6"), ("intermediate", "5.7")):
        shown = select(curves, context=context, gain=0.05)
        after = shown[shown["scan"] > COMES]
        peak = int(after.loc[after["ignorance"].idxmax(), "scan"])
        claims.append(Claim(f"section 5.4, figure {figure}", "peak of ignorance", f"scan {LEAVES}",
                            f"scan {peak}", *((Verdict.EQUALS,) if peak == LEAVES else
                                              (Verdict.FALLS_SHORT, "the figure below"))))
    shown = select(curves, context="road", gain=0.05).set_index("scan")["accumulator"]
    rise = int((shown.loc[:LEAVES - 1] > 0).sum())
    fall = int((shown.loc[LEAVES:] > 0).sum()) + 1
    claims.append(Claim("section 5.4", "the accumulator falls faster than it rose",
                        "at a much faster rate", f"{rise} scans up, {fall} down",
                        *((Verdict.EQUALS,) if fall < rise else
                          (Verdict.FALLS_SHORT, "the figure below"))))
    return claims


def section(data) -> Section:
    curves, stops = data["evidential_curves"], data["evidential_stops"]
    stop_rows = [[ageing, *(_stop(stops, context=context, ageing=ageing, rates=rates, gain=gain)
                            for rates in ("exchanged", "as printed") for context in NAMES
                            for gain in GAINS)] for ageing in AGEINGS]
    rows = {context: [[row.scan, *(fixed(getattr(row, column), 4) for column in MASSES)]
                      for row in select(curves, context=context, gain=0.05).itertuples()
                      if row.scan in SHOWN_SCANS] for context in NAMES}
    exact = [ageing for ageing in AGEINGS
             if all(_stop(stops, context=context, ageing=ageing, rates="exchanged", gain=gain)
                    == printed for context in NAMES for gain, printed in PRINTED_STOPS.items())]
    unexchanged = [_stop(stops, context=context, ageing=ageing, rates="as printed", gain=0.05)
                   for context in NAMES for ageing in AGEINGS]
    return Section(
        found={"rows": rows, "names": NAMES, "stops": stop_rows, "exact": exact,
               "unexchanged": sorted(set(unexchanged)),
               "difference": _largest_difference_of_contexts(curves)},
        claims=_claims(curves, stops),
        figures={"road.svg": _figure(curves, "road", 0.05),
                 "road_fast.svg": _figure(curves, "road", 0.15),
                 "intermediate.svg": _figure(curves, "intermediate", 0.05)})
