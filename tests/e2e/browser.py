"""Debian's Chromium without a window, driven by Debian's Selenium."""

import base64
import io
import os
import pathlib

import PIL.Image
from selenium.common.exceptions import TimeoutException
from selenium.webdriver import Chrome, ChromeOptions
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.wait import WebDriverWait

FLAGS = ["--headless=new", "--disable-gpu", "--hide-scrollbars", "--mute-audio",
         "--disable-component-update", "--disable-extensions", "--disable-dev-shm-usage",
         "--force-color-profile=srgb"]


class Browser(Chrome):
    """One process of Chromium. Use it in a `with` statement, or it stays."""

    def __init__(self, folder: pathlib.Path):
        folder.mkdir(parents=True, exist_ok=True)
        options = ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        # Chromium's sandbox does not run as root; what it opens here is our own page.
        for flag in FLAGS + ["--no-sandbox"] * (os.geteuid() == 0):
            options.add_argument(flag)
        # A hidden page runs as seldom as it does for a user.
        options.add_experimental_option("excludeSwitches", ["disable-background-timer-throttling"])
        options.set_capability("goog:loggingPrefs", {"browser": "WARNING"})
        super().__init__(options=options, service=Service(
            service_args=["--enable-chrome-logs"], log_file=(folder / "chromium.txt").open("wb")))

    def open(self, address: str, width: int = 1366, height: int = 768, dark: bool = True) -> "Page":
        """A page of that size in a window of its own, which hides no other."""
        self.switch_to.window(self.window_handles[0])  # the last one may have been closed
        self.switch_to.new_window("window")
        self.chosen = page = Page(self, self.current_window_handle)
        page.ask("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        page.load(address, width, height)
        return page


class Page:
    """A window of the browser. Places are pixels from its left upper corner."""

    def __init__(self, browser: Browser, handle: str):
        self._browser = browser
        self._handle = handle
        self._complaints: list[dict] = []

    def browser(self) -> Browser:
        """Which does what comes next in this window."""
        if self._browser.chosen is not self:
            self._browser.switch_to.window(self._handle)
            self._browser.chosen = self
        return self._browser

    def ask(self, method: str, **parameters) -> dict:
        """Calls a method of the DevTools protocol, for what WebDriver does not offer."""
        return self.browser().execute_cdp_cmd(method, parameters)

    def load(self, address: str, width: int = 1366, height: int = 768) -> None:
        """Begins anew with that size."""
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.browser().get(address)

    def close(self) -> None:
        self.browser().close()
        self.complaints()  # are those of a page that is gone

    def hide(self) -> None:
        self.browser().minimize_window()

    def run(self, script: str):
        """What the JavaScript returns, or its promise comes to."""
        return self.browser().execute_script(script)

    def value(self, expression: str):
        return self.run(f"return {expression}")

    def has_come(self, expression: str, longest_s: float) -> bool:
        """Whether the expression becomes true, if need be on the page that comes next."""
        try:
            WebDriverWait(self, longest_s, 0.02).until(lambda _: self.value(f"Boolean({expression})"))
        except TimeoutException:
            return False
        return True

    def wait_for(self, expression: str, longest_s: float = 20) -> None:
        if not self.has_come(expression, longest_s):
            words = " ".join(self.value("document.body.innerText").split())
            raise AssertionError(f"in vain waited for {expression}; the page says: {words}; "
                                 f"{self.complaints()}")

    def complaints(self) -> list[dict]:
        """Errors and warnings of the console, and exceptions that nobody caught, on any open page."""
        self._complaints += self._browser.get_log("browser")
        return self._complaints

    def press(self, key: str) -> None:
        self.hands().send_keys(key).perform()

    def hands(self) -> ActionChains:
        """On keyboard and mouse, as quick as can be."""
        return ActionChains(self.browser(), duration=0)

    def touch(self, kind: str, *places: tuple[float, float]) -> None:
        """Fingers: touchStart and touchMove with all that are down, touchEnd with those that stay."""
        self.ask("Input.dispatchTouchEvent", type=kind, touchPoints=[
            {"x": column, "y": row, "id": finger} for finger, (column, row) in enumerate(places)])

    def move_to(self, column: float, row: float) -> None:
        hands = self.hands()
        hands.w3c_actions.pointer_action.move_to_location(column, row)
        hands.perform()

    def click(self, selector: str) -> None:
        self.hands().click(self.browser().find_element(By.CSS_SELECTOR, selector)).perform()

    def screenshot(self, path: pathlib.Path) -> None:
        path.write_bytes(self.browser().get_screenshot_as_png())

    def pixel(self, column: float, row: float) -> tuple[int, int, int]:
        """The colour of a place on the page, as it is seen."""
        return self.pixels(column, row, 1, 1)[0]

    def pixels(self, column: float, row: float, width: int, height: int) -> list[tuple[int, int, int]]:
        """Those of a rectangle, row by row."""
        data = self.ask("Page.captureScreenshot", clip={"x": int(column), "y": int(row), "width": width,
                                                        "height": height, "scale": 1})["data"]
        return list(PIL.Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB").getdata())
