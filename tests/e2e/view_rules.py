"""What the page and its server must never do, whoever asks and whatever a file is called."""

import base64
import hashlib
import http.client
import os
import pathlib
import resource
import socket
import struct
import subprocess
import time

import made_stream
import vehicle_id
from browser import Browser
from viewer import GridPage, Viewer, free_port


def status_of(port: int, method: str, path: str, host: str) -> tuple[int, dict[str, str]]:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
    connection.putrequest(method, path, skip_host=True)
    connection.putheader("Host", host)
    connection.endheaders()
    response = connection.getresponse()
    response.read()
    return response.status, {name.lower(): value for name, value in response.getheaders()}


def check_hosts(viewer: Viewer) -> None:
    """Names that somebody may have pointed at this PC are refused, whatever they ask for."""
    own = f"127.0.0.1:{viewer.port}"
    status, headers = status_of(viewer.port, "GET", "/", own)
    assert status == 200
    policy = headers["content-security-policy"]
    assert "default-src 'none'" in policy and "unsafe" not in policy, policy
    assert headers["x-content-type-options"] == "nosniff"
    assert status_of(viewer.port, "GET", "/", f"localhost:{viewer.port}")[0] == 200
    for host in ("example.org", f"example.org:{viewer.port}", "127.0.0.1.example.org", ""):
        for path in ("/", "/view.js", "/live"):
            assert status_of(viewer.port, "GET", path, host)[0] in (400, 403), (host, path)
    assert status_of(viewer.port, "POST", "/", own)[0] == 405
    for path in ("/nothing", "/../view.html", "//", "/view.html?x", "/%2e%2e/etc/passwd"):
        assert status_of(viewer.port, "GET", path, own)[0] == 404, path


class Socket:
    """A WebSocket by hand: it opens one, and reads messages without ever saying `ready`."""

    def __init__(self, port: int, origin: str):
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=10)
        key = base64.b64encode(os.urandom(16)).decode()
        self._socket.sendall((f"GET /live HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n"
                              f"Origin: {origin}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n"
                              ).encode())
        self._file = self._socket.makefile("rb")
        self.status = int(self._file.readline().split()[1])
        while (line := self._file.readline()) not in (b"\r\n", b""):
            if line.lower().startswith(b"sec-websocket-accept:"):
                mark = key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
                answer = base64.b64encode(hashlib.sha1(mark.encode()).digest())
                assert line.split()[1] == answer, "not the answer of RFC 6455"

    def messages(self, seconds: float) -> int:
        """How many come in that time."""
        count = 0
        deadline = time.monotonic() + seconds
        while (rest := deadline - time.monotonic()) > 0:
            self._socket.settimeout(rest)
            try:
                head = self._file.read(2)
                size = head[1] & 0x7F
                if size >= 126:
                    size = struct.unpack(">H" if size == 126 else ">Q",
                                         self._file.read(2 if size == 126 else 8))[0]
                self._file.read(size)
            except TimeoutError:
                break
            count += head[0] & 0x0F == 2
        return count

    def send(self, words: bytes) -> None:
        self._socket.sendall(bytes((0x81, 0x80 | len(words))) + bytes(4) + words)

    def close(self) -> None:
        self._file.close()
        self._socket.close()


def check_sockets(viewer: Viewer) -> None:
    """Only a page of this server may read along; one that is slow is never sent a queue."""
    for origin in ("http://example.org", f"https://127.0.0.1:{viewer.port}", "null", "",
                   f"http://127.0.0.1:{viewer.port}.example.org", f"http://localhost:{viewer.port}"):
        stranger = Socket(viewer.port, origin)
        assert stranger.status == 403, origin
        stranger.close()
    slow = Socket(viewer.port, f"http://127.0.0.1:{viewer.port}")
    assert slow.status == 101
    assert slow.messages(1.5) == 2, "more messages than a page has asked for"
    slow.close()
    rude = Socket(viewer.port, f"http://127.0.0.1:{viewer.port}")
    rude.send(b"../../etc/passwd")
    rude.send(b"record\nx")
    assert rude.messages(0.5) == 2
    rude.close()


def check_many(viewer: Viewer) -> None:
    """More pages than it serves at a time do not keep it from going on."""
    own = f"http://127.0.0.1:{viewer.port}"
    pages = []
    for _ in range(20):
        try:
            pages.append(Socket(viewer.port, own))
        except (OSError, IndexError):
            break
    assert 8 <= len(pages) <= 16, len(pages)
    assert status_of(viewer.port, "GET", "/", f"127.0.0.1:{viewer.port}")[0] == 200
    for page in pages:
        page.close()


def check_siege(iog: str) -> None:
    """Connections that ask nothing, more than there are file descriptors, cost no processor time, and
    it serves again when they are gone."""
    with Viewer(iog, "--port", str(free_port())) as viewer:
        resource.prlimit(viewer.process, resource.RLIMIT_NOFILE, (40, 40))
        idle = [socket.create_connection(("127.0.0.1", viewer.port), timeout=10) for _ in range(60)]
        time.sleep(0.3)
        before = viewer.processor_s
        time.sleep(1)
        assert viewer.processor_s - before < 0.3, viewer.processor_s - before
        for one in idle:
            one.close()
        assert status_of(viewer.port, "GET", "/", f"127.0.0.1:{viewer.port}")[0] == 200


def seconds_a_frame(page: GridPage, frames: int) -> float:
    """That many take: 0.04 s, or more on a busy machine."""
    begin = time.monotonic()
    last = page.page.value("iogPage.history.count") + frames
    page.page.wait_for(f"iogPage.history.count >= {last}", 60)
    return (time.monotonic() - begin) / frames


def check_crowd(iog: str, browser: Browser) -> None:
    """Pages that come and go leave nothing behind; one that is slow, one that never answers and one
    that is hidden delay nobody. A hidden page still says in its title what has become of the stream."""
    with Viewer(iog, "--simulate", "city") as viewer:
        own = f"http://127.0.0.1:{viewer.port}"
        first = GridPage(browser.open(viewer.address))
        first.page.hide()
        usual_s = seconds_a_frame(first, 25)
        before, files = viewer.memory_bytes, viewer.files
        for _ in range(100):
            Socket(viewer.port, own).close()
        visitor = browser.open(viewer.address)
        for _ in range(5):
            GridPage(visitor).page.wait_for("iogPage.history.count > 0")
            assert not visitor.complaints(), visitor.complaints()
            visitor.load(viewer.address)
        visitor.close()
        silent = [Socket(viewer.port, own) for _ in range(4)]
        slow = GridPage(browser.open(viewer.address))
        slow.page.ask("Emulation.setCPUThrottlingRate", rate=10)
        count = "iogPage.status.frame.number - iogPage.history.count"
        skipped = first.page.value(count)
        frames = first.page.value("iogPage.history.count")
        seconds = seconds_a_frame(first, 75)
        frames = first.page.value("iogPage.history.count") - frames
        skipped = first.page.value(count) - skipped
        assert seconds < max(1 / 7, 3 * usual_s), (seconds, usual_s)
        assert skipped <= frames, (frames, skipped)
        assert viewer.memory_bytes < before + (16 << 20), (before, viewer.memory_bytes)
        for one in silent:
            one.close()
        slow.page.close()
        deadline = time.monotonic() + 10
        while viewer.files > files + 8:  # the browser keeps some for its next request
            assert time.monotonic() < deadline, (files, viewer.files)
            time.sleep(0.1)
        assert first.page.value("document.hidden"), "the page is not hidden"
        assert first.page.value("document.title") == "live – iogrid"
        viewer.stop()
        first.page.wait_for("document.title === 'no server – iogrid'")
        first.page.close()


def check_words(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    """Words from outside are words: a file's name; and a car that nobody knows is called so. A warm chip is told."""
    name = '<img src=x onerror="document.title=1"><b>&amp;.pcap'
    drive = folder / name
    subprocess.run([iog, "simulate", "--seconds", "1", "--out", drive], check=True,
                   stdout=subprocess.DEVNULL)
    with Viewer(iog, "--pcap", str(drive)) as viewer:
        page = GridPage(browser.open(viewer.address))
        page.page.wait_for("document.getElementById('origin').textContent !== ''")
        assert name in page.page.value("document.getElementById('origin').textContent")
        assert page.page.value("document.querySelectorAll('img, b b, span b').length") == 1
        page.wait_for_state("end of recording")
        assert page.page.value("document.title") == "end of recording – iogrid"
        assert not page.page.complaints(), page.page.complaints()
        page.page.close()
    port = free_port()
    with Viewer(iog, "--port", str(port)) as viewer:
        page = GridPage(browser.open(viewer.address))
        target = made_stream.Target(port, vehicle=vehicle_id.NOBODY)
        target.temperature_dc = 861
        target.send(made_stream.Grid())
        page.page.wait_for("document.getElementById('vehicle').textContent.startsWith('unknown car 12345678')")
        for _ in range(100):
            target.send(made_stream.Grid())
            time.sleep(0.05)
            if "warm: 86.1 degrees Celsius" in page.banner:
                break
        assert "warm: 86.1 degrees Celsius" in page.banner, page.banner
        assert not page.page.complaints(), page.page.complaints()
        page.page.close()


def check(iog: str, folder: pathlib.Path, browser: Browser) -> None:
    with Viewer(iog, "--simulate", "city") as viewer:
        check_hosts(viewer)
        check_sockets(viewer)
        check_many(viewer)
    check_siege(iog)
    check_crowd(iog, browser)
    check_words(iog, folder, browser)
