"""How well words can be read: contrast by WCAG 2.1, as people with protanopia and with every cone see it."""

# Machado, Oliveira and Fernandes 2009, table 1, severity 1.0; on linear RGB.
SEEN_BY = {"everybody": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
           "protanopes": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
           "deuteranopes": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881))}
READABLE = 4.5  # WCAG 2.1, 1.4.3


def luminance(colour, eye) -> float:
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in (value / 255 for value in colour)]
    seen = [min(1, max(0, sum(a * b for a, b in zip(row, linear)))) for row in eye]
    return 0.2126 * seen[0] + 0.7152 * seen[1] + 0.0722 * seen[2]


def contrast(words, card, below) -> float:
    """The least of all eyes, of words on a card (r, g, b and how far it covers) that lies over a colour."""
    paper = [card[3] * c + (1 - card[3]) * b for c, b in zip(card, below)]
    pairs = [sorted((luminance(words, eye), luminance(paper, eye))) for eye in SEEN_BY.values()]
    return min((light + 0.05) / (dark + 0.05) for dark, light in pairs)
