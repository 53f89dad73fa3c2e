"""What `iog view --foxglove` does with clients that keep to no rule: a status, an answer or a close,
and all others go on."""

import json
import os
import pathlib
import socket
import struct
import time

from readers import Listener
from rude_client import BINARY, CLOSE, PING, PONG, TEXT, RudeClient, frame, handshake
from viewer import Viewer

MIB = 1 << 20
PROTOCOL_ERROR, BAD_PAYLOAD, TOO_BIG = 1002, 1007, 1009  # RFC 6455, 7.4.1
ERROR = 2
MOST_CLIENTS = 16


def check_handshakes(address: tuple[str, int]) -> None:
    """Who may come in, and who is told why not."""
    for changed, status in (
            ({}, 101), ({"Sec_WebSocket_Protocol": "other, foxglove.sdk.v1"}, 101),
            ({"Origin": "https://app.foxglove.dev"}, 101), ({"Origin": "http://localhost:3000"}, 101),
            ({"Origin": "file://"}, 101), ({"Host": "localhost:1"}, 101),
            ({"Sec_WebSocket_Protocol": None}, 400), ({"Sec_WebSocket_Protocol": "foxglove.websocket.v2"}, 400),
            ({"Upgrade": None, "Connection": None}, 426), ({"Origin": "https://example.com"}, 403),
            ({"Origin": "https://foxglove.dev.example.com"}, 403), ({"Origin": "http://app.foxglove.dev"}, 403),
            ({"Origin": "https://notfoxglove.dev"}, 403), ({"Origin": "null"}, 403), ({"Host": "example.com"}, 403),
            ({"Host": None}, 403), ({"Sec_WebSocket_Key": None}, 400), ({"Sec_WebSocket_Version": "12"}, 426)):
        with RudeClient(address, handshake(address, **changed)) as client:
            assert client.status == status, (changed, client.status, client.headers)
            if status == 101:
                wanted = changed.get("Sec_WebSocket_Protocol", "foxglove.websocket.v1").split(", ")[-1]
                assert client.headers["sec-websocket-protocol"] == wanted
                assert client.next_json("serverInfo")["capabilities"] == []
                client.next_json("advertise")
    for request in (b"\r\n\r\n", b"GET /" + 70_000 * b"x" + b" HTTP/1.1\r\n\r\n", os.urandom(4096) + b"\r\n\r\n"):
        with socket.create_connection(address, timeout=20) as stranger:
            stranger.sendall(request)
            try:
                while stranger.recv(4096):
                    pass
            except ConnectionError:
                pass


def check_requests(address: tuple[str, int]) -> None:
    """Each request that cannot be met has a status that names what is wrong, and the connection goes on."""
    def subscription(**wanted) -> dict:
        return {"op": "subscribe", "subscriptions": [wanted]}

    with RudeClient(address) as client:
        channels = client.next_json("advertise")["channels"]
        first, second = (channel["id"] for channel in channels[:2])
        client.ask(subscription(id=5, channelId=first))
        for request, words in (
                ("", "must be a JSON object"), ("{", "must be a JSON object"), ("[]", "must be a JSON object"),
                ("17", "must be a JSON object"), ('{"op": 3}', "must be a JSON object"), ("{}", "must be a JSON object"),
                ('{"op": ""}', "must be a JSON object"), ("[" * 60_000, "must be a JSON object"),
                ('{"op": "' + "\u00fc" * 200 + '"}', "is no operation"),
                ({"op": "shutdown"}, '"shutdown" is no operation'), ({"op": "subscribe"}, 'no list "subscriptions"'),
                ({"op": "subscribe", "subscriptions": {}}, 'no list "subscriptions"'),
                ({"op": "unsubscribe", "subscriptionIds": 5}, 'no list "subscriptionIds"'),
                ({"op": "unsubscribe", "subscriptionIds": [6]}, "no subscription 6"),
                ({"op": "unsubscribe", "subscriptionIds": ["5"]}, "whole number"),
                (subscription(id=5, channelId=second), "subscription 5: this id is in use"),
                (subscription(id=6, channelId=first), f"channel {first} has a subscription already"),
                (subscription(id=6, channelId=10 ** 6), "no channel 1000000"), (subscription(id=6), "whole number"),
                (subscription(channelId=second), "whole number"), (subscription(id=-1, channelId=second), "whole number"),
                (subscription(id=1 << 32, channelId=second), "whole number"),
                (subscription(id=1.5, channelId=second), "whole number"),
                ({"op": "subscribe", "subscriptions": [7, None, []]}, "whole number"),
                ({"op": "advertise", "channels": []}, '"clientPublish"'), ({"op": "unadvertise"}, '"clientPublish"'),
                ({"op": "getParameters", "parameterNames": []}, '"parameters"'),
                ({"op": "subscribeConnectionGraph"}, '"connectionGraph"'), ({"op": "fetchAsset"}, '"assets"')):
            client.ask(request)
            answer = client.next_json("status")
            assert answer["level"] == ERROR and words in answer["message"], (request, answer)
            if request == {"op": "subscribe", "subscriptions": [7, None, []]}:
                assert [client.next_json("status")["level"] for _ in range(2)] == [ERROR, ERROR]
        for message, words in ((b"\1\0\0\0\0data", '"clientPublish"'), (b"\2" + bytes(20), '"services"'),
                               (b"\xff", "not known"), (b"", "no bytes")):
            client.send(frame(BINARY, message))
            assert words in client.next_json("status")["message"], message
        client.ask({"op": "subscribe", "subscriptions": [{"id": i, "channelId": 10 ** 6} for i in range(1000)]})
        answers = [client.next_json("status")["message"] for _ in range(8)]
        assert answers[0].startswith("subscription 0:") and answers[-1].startswith("993 more"), answers
        client.ask({"op": "unsubscribe", "subscriptionIds": [5]})
        client.ask(subscription(id=5, channelId=second))
        client.ask({"op": "settle"})
        assert "settle" in client.next_json("status")["message"], "what is in order has no status"


def check_frames(address: tuple[str, int]) -> None:
    """Frames in pieces are whole again; what breaks RFC 6455, or is too large, ends the connection."""
    text = json.dumps({"op": "in pieces"}).encode()
    with RudeClient(address) as client:
        client.send(frame(TEXT, text[:5], is_last=False) + frame(PING, b"between")
                    + frame(0, text[5:9], is_last=False) + frame(0, text[9:]))
        while (found := client.next())[0] != PONG:
            pass
        assert found[1] == b"between"
        assert "in pieces" in client.next_json("status")["message"]
    piece = frame(0, 4096 * b" ", is_last=False)
    for data, code in ((frame(TEXT, 70_000 * b" "), TOO_BIG),
                       (frame(TEXT, b"", is_last=False) + 17 * piece, TOO_BIG),
                       (frame(TEXT, b"", length=1 << 62), TOO_BIG), (frame(TEXT, text, is_masked=False), PROTOCOL_ERROR),
                       (frame(TEXT, b"\xff\xfe"), BAD_PAYLOAD), (frame(5, text), PROTOCOL_ERROR),
                       (frame(TEXT, text, reserved=4), PROTOCOL_ERROR), (frame(0, text), PROTOCOL_ERROR),
                       (frame(PING, 126 * b"x"), PROTOCOL_ERROR), (frame(CLOSE, struct.pack(">H", 1000)), 1000)):
        with RudeClient(address) as client:
            client.try_to_send(data, 5)
            assert client.end() == code, (data[:16], code)
    for data in (os.urandom(3000), frame(TEXT, text)[:4], frame(TEXT, text, length=1000)):
        with RudeClient(address) as client:
            client.try_to_send(data, 5)


def check_floods(address: tuple[str, int], viewer: Viewer) -> None:
    """Who asks without end and reads no answer is not read either; who comes in crowds stays outside."""
    before = viewer.memory_bytes
    with RudeClient(address) as client:
        flood = 2000 * frame(TEXT, b'{"op": "' + 100 * b"x" + b'"}')
        for _ in range(200):
            if not client.try_to_send(flood, 2):
                break
        else:
            raise AssertionError("50 MB of requests have been read")
        assert viewer.memory_bytes - before < 16 * MIB
    crowd = [RudeClient(address) for _ in range(MOST_CLIENTS + 4)]
    statuses = [client.status for client in crowd]
    for client in crowd:
        client.__exit__()
    assert statuses.count(503) >= 4 and set(statuses) == {101, 503}, statuses


def wait_for_room(address: tuple[str, int]) -> None:
    for _ in range(100):
        with RudeClient(address) as client:
            if client.status == 101:
                return
        time.sleep(0.05)
    raise AssertionError("those who have left are still counted")


def check(place: pathlib.Path, viewer: Viewer, scene) -> None:
    """All of it, while another client gets a frame after each."""
    address = ("127.0.0.1", viewer.foxglove_port)
    with Listener(place, viewer.foxglove) as listener:
        assert {"/tf", "/grid", "/iogrid/grid"} <= set(listener.topics), "they are known from earlier clients"
        topics = {"/tf": 1, "/grid": 1, "/iogrid/grid": 1}
        listener.subscribe(*topics)
        for rudeness in (check_handshakes, check_requests, check_frames, lambda there: check_floods(there, viewer),
                         wait_for_room):
            rudeness(address)
            scene.send()
            found = listener.frame(topics)
            assert found["/iogrid/grid"][0]["found"]["crc"] == f"{scene.grid.crc:08x}"
