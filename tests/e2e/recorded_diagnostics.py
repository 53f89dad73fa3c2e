"""What `iog record` writes as /diagnostics: a part of tests/e2e/recordings."""

import signal

import made_classes
import made_stream


def check(tools, contents: dict, port: int, frames: int) -> None:
    """Each frame says of every sensor how it is, and what nobody watches; what is bad is no OK. This drive has no
    poses, and nobody of its car looks to the sides."""
    sensors = [f"sensor {mount['name']}" for mount in contents["mounts"]]
    assert len(contents["diagnostics"]) == frames
    for found in contents["diagnostics"][1:]:
        assert [found[name]["message"] for name in sensors] == ["complete"] * 4, found
        bad = {name: (each["level"], each["message"]) for name, each in found.items() if each["level"] > 0}
        assert bad == {"surroundings": (1, "not watched: 84 to 135, -135 to -84 degrees"), "poses": (2, "lost")}, bad
        assert {each["hardware_id"] for each in found.values()} == {"reference_car"}
        assert int(found["points"]["values"]["used"]) > 1000 and found["stream"]["message"] == "whole", found
        assert "loop" not in found, "a PC has none"
    path = tools.folder / "diagnostics.mcap"
    with tools.recorder("--out", path) as process:
        target = made_stream.Target(port)
        for number in range(2):
            target.unwatched = number * 0b11 << 16
            window = made_classes.Window()
            messages = target.messages_of(made_stream.Grid(), points_used=100, window=window)
            for message in messages[number:]:
                target.send_bytes(message)
        target.send(made_stream.Grid(), points_used=100, window=made_classes.Window())
        for number in range(3):
            assert process.stdout.readline() == f"frame {number}\n"
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0, process.stderr.read()
    whole, cut, _ = tools.read_mcap(path)["diagnostics"]
    assert [each["surroundings"]["level"] for each in (whole, cut)] == [0, 1], (whole, cut)
    assert cut["surroundings"]["message"] == "not watched: 90 to 101 degrees", cut
    assert [each["stream"]["message"] for each in (whole, cut)] == ["whole", "messages are missing"], (whole, cut)
    assert whole["poses"]["message"] == "in order", whole
