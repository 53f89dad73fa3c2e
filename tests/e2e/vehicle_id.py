"""How a stream names cars (docs/spec.md 3.2)."""

REFERENCE_CAR = 0x01FFB0CD  # as tests/host/vehicles/descriptions_test.cpp has it
NOBODY = 0x12345678
