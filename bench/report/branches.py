"""How many conditional branches of a trace a processor would not have foreseen: by a predictor of the kind that they have, with a counter for each branch
and each history of branches before it; of several histories the longest that was seen before decides (Seznec and Michaud, A case for (partially) TAgged
GEometric history length branch prediction, 2006)."""
HISTORIES = (4, 8, 16, 32, 64, 128)  # branches before


class Predictor:
    """Without limits: no two branches share a counter."""

    def __init__(self):
        self._history, self._alone, self._after = 0, {}, [{} for _ in HISTORIES]

    def is_wrong(self, branch, taken):
        """Whether it did not foresee this; then it has seen it."""
        keys = [(branch, self._history & (1 << length) - 1) for length in HISTORIES]
        known = max((k for k, key in enumerate(keys) if key in self._after[k]), default=-1)
        table, key = (self._after[known], keys[known]) if known >= 0 else (self._alone, branch)
        counter = table.get(key, 0)
        wrong = (counter >= 0) != taken
        table[key] = max(-4, min(3, counter + (1 if taken else -1)))
        if wrong and known + 1 < len(HISTORIES):
            self._after[known + 1][keys[known + 1]] = 0 if taken else -1
        self._history = (self._history << 1 | taken) & (1 << HISTORIES[-1]) - 1
        return wrong


def outcomes(executed, texts, places):
    """(position, address, whether it was taken) of the conditional branches that a call executed. texts, places: by address, as bounds.py has them."""
    for position, (at, then) in enumerate(zip(executed, executed[1:])):
        text = texts.get(at, "")
        if text.startswith("j") and not text.startswith("jmp"):
            yield position, at, then in places and places[then][1] == int(text.split()[1], 16)


def wrong_branches(calls, texts, places):
    """(wrong ones, instructions) in the second half of what the calls executed; the first half is what the predictor has seen by then."""
    predictor, total, done, wrong = Predictor(), sum(map(len, calls)), 0, 0
    for executed in calls:
        for position, at, taken in outcomes(executed, texts, places):
            wrong += predictor.is_wrong(at, taken) and 2 * (done + position) >= total
        done += len(executed)
    return wrong, total / 2
