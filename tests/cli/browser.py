"""A headless browser that stays open, controlled over its debugging pipe: opens, inspects and clicks pages."""

import base64
import fcntl
import json
import os
import select
import subprocess
import tempfile

from pages import BROWSER

FLAGS = ["--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-extensions", "--force-color-profile=srgb", "--hide-scrollbars",
         "--remote-debugging-pipe"]
WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
NO_WEBGL = ["--disable-gpu"]  # a page is drawn in half the time


class Browser:
    def __init__(self, drawing=WEBGL):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.number, self.loads, self.messages, self.console, self.session = 0, 0, b"", [], None
        commands, self.out = os.pipe()
        self.into, answers = os.pipe()
        # It reads commands from descriptor 3 and answers on 4; copies from 10 on, so that neither overwrites the
        # other.
        ends = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (commands, answers)]
        self.process = subprocess.Popen([BROWSER, *FLAGS, *drawing, f"--user-data-dir={self.folder.name}"], close_fds=False,
                                        preexec_fn=lambda: [os.dup2(ends[0], 3), os.dup2(ends[1], 4)],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for end in (commands, answers, *ends):
            os.close(end)
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.send(f"{domain}.enable")
        self.size(1200, 900)

    def close(self):
        os.close(self.out)
        self.process.terminate()
        self.process.wait(timeout=20)
        os.close(self.into)
        self.folder.cleanup()

    def receive(self):
        while b"\0" not in self.messages:
            assert select.select([self.into], [], [], 60)[0], "the browser says nothing"
            piece = os.read(self.into, 1 << 20)
            assert piece, "the browser is gone"
            self.messages += piece
        text, _, self.messages = self.messages.partition(b"\0")
        message = json.loads(text)
        if message.get("method") in ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded"):
            self.console.append(message["params"])
        self.loads += message.get("method") == "Page.loadEventFired"
        return message

    def send(self, method, **params):
        self.number += 1
        command = {"id": self.number, "method": method, "params": params}
        if self.session:
            command["sessionId"] = self.session
        os.write(self.out, json.dumps(command).encode() + b"\0")
        while True:
            message = self.receive()
            if message.get("id") == self.number:
                assert "error" not in message, message["error"]
                return message["result"]

    def size(self, width, height, mobile=False, scale=1):
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=mobile)

    def dark(self, on):
        features = [{"name": "prefers-color-scheme", "value": "dark" if on else "light"}]
        self.send("Emulation.setEmulatedMedia", features=features)

    def open(self, path):
        """Opens a file and waits until its scripts have run."""
        for place in ("about:blank", f"file://{path}"):  # a new page even if only the fragment changes
            self.console.clear()
            loads = self.loads
            self.send("Page.navigate", url=place)
            while self.loads == loads:
                self.receive()

    def run(self, script):
        """The value of a script, awaited if it is a promise."""
        done = self.send("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in done, done["exceptionDetails"]
        return done["result"].get("value")

    def settle(self):
        """Waits until the requested drawing is done."""
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done))))")

    def press(self, key, code, modifiers=0):
        for kind in ("rawKeyDown", "keyUp"):
            self.send("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, modifiers=modifiers)
        self.settle()

    def drag(self, x, y, across, down):
        for kind, dx, dy in (("mousePressed", 0, 0), ("mouseMoved", across, down), ("mouseReleased", across, down)):
            self.send("Input.dispatchMouseEvent", type=kind, x=x + dx, y=y + dy, button="left", buttons=1, clickCount=1)
        self.settle()

    def picture(self, clip=None):
        """A screenshot as PNG; `clip`: of the element with this id only."""
        more = {}
        if clip:
            box = self.run(f"""(() => {{ const b = document.getElementById("{clip}").getBoundingClientRect();
                return {{ x: b.x + scrollX, y: b.y + scrollY, width: b.width, height: b.height, scale: 1 }}; }})()""")
            more["clip"] = box
        self.settle()
        return base64.b64decode(self.send("Page.captureScreenshot", format="png", **more)["data"])
