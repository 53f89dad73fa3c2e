"""Debian's Chromium without a window, driven by its DevTools protocol through a pair of pipes."""

import base64
import io
import json
import os
import pathlib
import select
import subprocess
import time

import PIL.Image

FLAGS = ["--headless=new", "--remote-debugging-pipe", "--no-first-run", "--disable-gpu",
         "--hide-scrollbars", "--mute-audio", "--disable-background-networking",
         "--disable-component-update", "--disable-default-apps", "--disable-extensions",
         "--disable-sync", "--disable-dev-shm-usage", "--no-default-browser-check",
         "--force-color-profile=srgb", "--enable-precise-memory-info"]
ANSWER_S = 60  # a busy machine may take long to start a browser


class PageGone(AssertionError):
    """The page that was asked has just been left for the next one, or is loaded anew."""


class Browser:
    """One process of Chromium. Use it in a `with` statement, or it stays."""

    def __init__(self, folder: pathlib.Path):
        folder.mkdir(parents=True, exist_ok=True)
        command_read, self._commands = os.pipe()
        self._answers, answer_write = os.pipe()
        # Chromium reads its commands from 3 and writes its answers to 4. Its sandbox does not run
        # as root; what it opens here is our own page.
        sandbox = ["--no-sandbox"] if os.geteuid() == 0 else []
        script = 'exec "$@" 3<&"$COMMANDS" 4>&"$ANSWERS"'
        with (folder / "chromium.txt").open("wb") as log:
            self._process = subprocess.Popen(
                ["bash", "-c", script, "bash", "chromium", *FLAGS, *sandbox,
                 f"--user-data-dir={folder / 'profile'}", "about:blank"],
                pass_fds=(command_read, answer_write), stdout=log, stderr=log,
                stdin=subprocess.DEVNULL,
                env={**os.environ, "COMMANDS": str(command_read), "ANSWERS": str(answer_write)})
        os.close(command_read)
        os.close(answer_write)
        self._received = b""
        self._number = 0
        self._events: list[dict] = []

    def __enter__(self) -> "Browser":
        return self

    def __exit__(self, *_) -> None:
        try:
            self.ask("Browser.close")
            self._process.wait(10)
        except (AssertionError, OSError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()
        os.close(self._commands)
        os.close(self._answers)

    def ask(self, method: str, session: str | None = None, **parameters) -> dict:
        """Calls a method of the protocol and returns its result."""
        self._number += 1
        request = {"id": self._number, "method": method, "params": parameters}
        if session:
            request["sessionId"] = session
        os.write(self._commands, json.dumps(request).encode() + b"\0")
        deadline = time.monotonic() + ANSWER_S
        while True:
            answer = self._next(deadline)
            assert answer is not None, f"Chromium does not answer {method}"
            if answer.get("id") == self._number:
                if "error" in answer:
                    words = f"{method}: {answer['error']}"
                    raise (PageGone if "navigated" in words else AssertionError)(words)
                return answer["result"]
            self._events.append(answer)

    def events(self, session: str) -> list[dict]:
        """What a page has reported since the last call, without being asked for."""
        while (event := self._next(time.monotonic())) is not None:
            self._events.append(event)
        events = [event for event in self._events if event.get("sessionId") == session]
        self._events = [event for event in self._events if event.get("sessionId") != session]
        return events

    def _next(self, deadline: float) -> dict | None:
        while b"\0" not in self._received:
            if not select.select([self._answers], [], [], max(0, deadline - time.monotonic()))[0]:
                return None
            chunk = os.read(self._answers, 1 << 20)
            assert chunk, "Chromium has ended"
            self._received += chunk
        text, _, self._received = self._received.partition(b"\0")
        return json.loads(text)

    def open(self, address: str, width: int = 1366, height: int = 768, dark: bool = True) -> "Page":
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        page = Page(self, session, target)
        page.ask("Page.enable")
        page.ask("Runtime.enable")
        page.ask("Log.enable")
        page.ask("Emulation.setDeviceMetricsOverride", width=width, height=height,
                 deviceScaleFactor=1, mobile=False)
        page.ask("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        page.ask("Page.navigate", url=address)
        return page


class Page:
    """A tab of the browser."""

    def __init__(self, browser: Browser, session: str, target: str):
        self._browser = browser
        self._session = session
        self._target = target
        self._complaints: list[str] = []

    def ask(self, method: str, **parameters) -> dict:
        return self._browser.ask(method, self._session, **parameters)

    def close(self) -> None:
        self._browser.ask("Target.closeTarget", targetId=self._target)

    def value(self, expression: str):
        """Of a JavaScript expression, which may be a promise."""
        answer = self.ask("Runtime.evaluate", expression=expression, returnByValue=True,
                          awaitPromise=True)
        assert "exceptionDetails" not in answer, (expression, answer["exceptionDetails"])
        return answer["result"].get("value")

    def wait_for(self, expression: str, longest_s: float = 20) -> None:
        """Until the expression is true, if need be on the page that comes next."""
        deadline = time.monotonic() + longest_s
        while not self._is_true(expression):
            assert time.monotonic() < deadline, (
                f"in vain waited for {expression}; the page says: {self._words()}")
            time.sleep(0.02)

    def _words(self) -> str:
        """What can be read on it, and what its console said."""
        try:
            text = " ".join(self.value("document.body.innerText").split())
            return f"{text}; {self.complaints()}"
        except PageGone:
            return "nothing, it is gone"

    def _is_true(self, expression: str) -> bool:
        try:
            return self.value(f"Boolean({expression})")
        except PageGone:
            return False

    def complaints(self) -> list[str]:
        """Errors and warnings of the console, and exceptions that nobody caught."""
        for event in self._browser.events(self._session):
            details = event.get("params", {})
            match event.get("method"):
                case "Runtime.exceptionThrown":
                    self._complaints.append(json.dumps(details["exceptionDetails"]))
                case "Runtime.consoleAPICalled" if details["type"] in ("error", "warning"):
                    self._complaints.append(json.dumps(details["args"]))
                case "Log.entryAdded" if details["entry"]["level"] in ("error", "warning"):
                    self._complaints.append(json.dumps(details["entry"]))
        return self._complaints

    def press(self, key: str, modifiers: int = 0) -> None:
        details = {"key": key, "modifiers": modifiers}
        if key == "Tab":  # moves the focus by its code, not by its name
            details |= {"windowsVirtualKeyCode": 9, "code": "Tab"}
        text = {"text": key} if len(key) == 1 and modifiers == 0 else {}
        self.ask("Input.dispatchKeyEvent", type="keyDown", **details, **text)
        self.ask("Input.dispatchKeyEvent", type="keyUp", **details)

    def touch(self, kind: str, *places: tuple[float, float]) -> None:
        """Fingers: touchStart and touchMove with all that are down, touchEnd with those that stay."""
        self.ask("Input.dispatchTouchEvent", type=kind, touchPoints=[
            {"x": column, "y": row, "id": finger} for finger, (column, row) in enumerate(places)])

    def move_to(self, column: float, row: float) -> None:
        self.ask("Input.dispatchMouseEvent", type="mouseMoved", x=column, y=row)

    def click(self, selector: str) -> None:
        box = self.value(f"(({{x, y, width, height}}) => [x + width / 2, y + height / 2])"
                         f"(document.querySelector('{selector}').getBoundingClientRect())")
        for kind in ("mousePressed", "mouseReleased"):
            self.ask("Input.dispatchMouseEvent", type=kind, x=box[0], y=box[1], button="left",
                     clickCount=1)

    def screenshot(self, path: pathlib.Path) -> None:
        path.write_bytes(self._picture())

    def pixel(self, column: float, row: float) -> tuple[int, int, int]:
        """The colour of a place on the page, as it is seen."""
        data = self._picture(clip={"x": int(column), "y": int(row), "width": 1, "height": 1,
                                   "scale": 1})
        return PIL.Image.open(io.BytesIO(data)).convert("RGB").getpixel((0, 0))

    def _picture(self, **parameters) -> bytes:
        answer = self.ask("Page.captureScreenshot", format="png", **parameters)
        return base64.b64decode(answer["data"])
