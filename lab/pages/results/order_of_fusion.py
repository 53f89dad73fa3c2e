"""What the order of a frame's scan points changes: in the thesis's sum (equation 4.4) and in the
firmware's rules."""

from types import SimpleNamespace

from claims import Claim, Verdict
from markdown import fixed, grouped, percent
from section import Section, one, select

PLACE = "equation 4.4"
NOT_SAID = "order not mentioned"  # by either paper
INT8_LIMIT = 127
START, STEP = 120, 14  # of the example: a cell near its limit, and as much as one beam carves
ORDERS = ["reversed", "by_sensor", "shuffled"]


def _saturated(index):
    return max(-INT8_LIMIT, min(INT8_LIMIT, index))


def _share(part, whole):
    return part / whole if whole else 0


class _Runs:
    """The drives of one pair of tables, each under two policies."""

    def __init__(self, outcomes, differences):
        assert (differences["cells"].to_numpy() <=
                outcomes["cells_of_both_signs"].repeat(1 + len(ORDERS)).to_numpy()).all(), \
            "a cell of one sign shows an order"
        self.outcomes = outcomes
        self._differences = differences
        self.above_bayes = int(outcomes["cells_above_bayes_in_any_order"].sum())
        self.changed = int(outcomes["cells_changed_under_firmware_rules"].sum())

    def difference(self, run, against):
        """The sequential sum in the order of arrival against another result, of one outcome."""
        return next(select(self._differences, drive=run.drive, policy=run.policy,
                           sequential_sum_against=against).itertuples())

    def _rows(self, cells_of):
        return [[run.drive, run.policy, *cells_of(run)] for run in self.outcomes.itertuples()]

    def against_bayes(self):
        def cells(run):
            found = self.difference(run, "bayes")
            return [grouped(run.known_cells), grouped(run.cells_of_both_signs),
                    grouped(found.cells), percent(_share(found.cells, run.known_cells), 3),
                    percent(_share(found.cells, run.cells_of_both_signs), 1),
                    grouped(found.cells_of_other_sign), grouped(found.largest_difference)]
        return self._rows(cells)

    def against_orders(self):
        def cells(run):
            found = [self.difference(run, order) for order in ORDERS]
            counts = [grouped(count) for each in found
                      for count in (each.cells, each.cells_of_other_sign)]
            return [*counts, percent(_share(found[-1].cells, run.cells_of_both_signs), 1)]
        return self._rows(cells)

    def share_of_both_signs(self):
        """The largest of all, and its drive."""
        shares = self.outcomes["cells_of_both_signs"] / self.outcomes["known_cells"]
        return SimpleNamespace(value=shares.max(), drive=self.outcomes["drive"][shares.idxmax()])

    def shares_not_bayes(self, policy):
        """Of the known cells, one share for each drive."""
        return [_share(self.difference(run, "bayes").cells, run.known_cells)
                for run in select(self.outcomes, policy=policy).itertuples()]


def _claim_on_grids(runs):
    changed = sum(runs.difference(run, "shuffled").frames for run in runs.outcomes.itertuples())
    return Claim(PLACE, "grids that a shuffle of their points changes, sequential sum", NOT_SAID,
                 f"{grouped(changed)} of {grouped(runs.outcomes['frames'].sum())}",
                 Verdict.DEPARTS, "a saturated sum of both signs is not associative")


def _claim_on_sequential(runs, where):
    def words(policy):
        shares = runs.shares_not_bayes(policy)
        least = f"{fixed(100 * min(shares), 3)} to " if len(shares) > 1 else ""
        return f"{least}{percent(max(shares), 3)} {policy}"
    return Claim(PLACE, f"known cells in which the sequential sum is not `bayes`, {where}",
                 NOT_SAID, ", ".join(words(policy) for policy in ("blurring", "nearest")),
                 Verdict.DEPARTS,
                 "our reading: it forgets what came before the saturation of a cell")


def _claim_on_firmware(runs, where):
    verdict = ((Verdict.DEPARTS, "our reading: all carving first, then all marking; sums of one "
                                 "sign commute")
               if runs.changed == 0 else (Verdict.FALLS_SHORT, "no order may show"))
    return Claim(PLACE, f"cells that change with the order under `hits_win` and `bayes`, {where}",
                 NOT_SAID, grouped(runs.changed), *verdict)


def _example():
    """The same two steps in both orders."""
    up_first = _saturated(_saturated(START + STEP) - STEP)
    down_first = _saturated(_saturated(START - STEP) + STEP)
    assert up_first != down_first, "the example shows no order"
    return SimpleNamespace(start=START, step=STEP, up_first=up_first, down_first=down_first)


def _until_full(data, step):
    """How many beams or hits of that step fill an int8."""
    index = abs(one(data["choice_indexes"], "index", epsilon=0.05, policy="blurring", step=step))
    return -(-INT8_LIMIT // index)


def section(data) -> Section:
    drive = _Runs(data["order_of_fusion"], data["order_of_fusion_differences"])
    recordings = _Runs(data["order_of_fusion_recordings"],
                       data["order_of_fusion_differences_recordings"])
    return Section(
        found={"drive": drive, "recordings": recordings, "frames": drive.outcomes["frames"][0],
               "example": _example(),
               "free_beams": _until_full(data, -12), "hits": _until_full(data, 0)},
        claims=[_claim_on_grids(drive), _claim_on_sequential(drive, "simulated"),
                _claim_on_firmware(drive, "simulated"),
                _claim_on_sequential(recordings, "recordings"),
                _claim_on_firmware(recordings, "recordings")])
