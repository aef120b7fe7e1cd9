"""A running `isoatlas view`, and what it is asked over HTTP."""
import atexit
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import urllib.error
import urllib.request

import harness

# Where viewers keep their tokens, and where those look who ask; where they keep their links.
RUNTIME = pathlib.Path(tempfile.mkdtemp(prefix="isoatlas-runtime-"))
STATE = pathlib.Path(tempfile.mkdtemp(prefix="isoatlas-state-"))
for private in (RUNTIME, STATE):
    atexit.register(shutil.rmtree, private, ignore_errors=True)
os.environ["XDG_RUNTIME_DIR"] = str(RUNTIME)
os.environ["XDG_STATE_HOME"] = str(STATE)


def token_file(port):
    return RUNTIME / "isoatlas" / f"viewer-{port}"


class Viewer:
    def __init__(self, folder, *arguments, wanted_token=None, browser="--no-browser", **options):
        """Returns once the address is printed. wanted_token: the one that its environment sets, and no file will hold; options: of the process."""
        self.process = subprocess.Popen([harness.CLI, "view", *arguments, *browser.split(), "--json"], cwd=folder, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, **options)
        self.document = self.read_document()
        if "error" in self.document:
            raise RuntimeError(f"it ended with {self.process.wait()}: {self.document['error']['message']}")
        self.port = self.document["port"]
        self.token = wanted_token or token_file(self.port).read_text().strip()

    def read_document(self):
        """The next one on its standard output."""
        lines = []
        while not lines or lines[-1] != "}\n":
            lines.append(self.process.stdout.readline())
            if lines[-1] == "":
                raise RuntimeError(f"it ended with {self.process.wait()}: {self.process.stderr.read()}")
        return json.loads("".join(lines))

    def stop(self):
        """Ctrl-C; the exit code and what it has said."""
        self.process.send_signal(signal.SIGINT)
        _, said = self.process.communicate(timeout=300)
        return self.process.returncode, said

    def request(self, path, token=None, **headers):
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{path}", headers=headers)
        request.add_header("Authorization", "Bearer " + (self.token if token is None else token))
        return request

    def ask(self, path, token=None, **headers):
        """Status, headers and body of an answer."""
        try:
            with urllib.request.urlopen(self.request(path, token, **headers), timeout=60) as answer:
                return answer.status, dict(answer.headers), answer.read()
        except urllib.error.HTTPError as error:
            return error.code, dict(error.headers), error.read()

    def change(self, path, token=None, data=None, **headers):
        """The same for PUT, with a body."""
        request = self.request(path, token, **headers)
        request.method, request.data = "PUT", data
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return answer.status, json.loads(answer.read())
        except urllib.error.HTTPError as error:
            return error.code, json.loads(error.read())

    def states(self, client="listener"):
        """What it says of itself and of the requests of a client, for as long as one listens."""
        with urllib.request.urlopen(self.request("/api/events", **{"X-Client": client}), timeout=60) as answer:
            for line in answer:
                if line.startswith(b"data: "):
                    yield json.loads(line[6:])

    def until(self, state):
        """All states up to the first one of that name."""
        found = []
        for one in self.states():
            found.append(one)
            if one["state"] == state:
                return found
        raise RuntimeError(f"no {state}: {found}")

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=30)

    def begin(self, path, client):
        """Asks and does not wait for an answer: a connection to close."""
        connection = self.connect()
        connection.sendall((f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\nAuthorization: Bearer {self.token}\r\n"
                            f"X-Client: {client}\r\n\r\n").encode())
        return connection
