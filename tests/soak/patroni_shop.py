"""A shop on a database: two dncd that are started again when they end, two lathes that run a program, and a CAM programmer who sends some.

What the server has acknowledged is noted, and judged at the end.
"""
import contextlib
import hashlib
import json
import pathlib
import shutil
import sqlite3
import subprocess
import threading
import time
import urllib.error
import urllib.request

LINES, MOVES_A_LINE = 4000, 50
PIECE = 1 << 20
LATHES = ("lathe-1", "lathe-2")


def program_of_lathe():
    text = ["O0300\nG20 G93 G98\nG0 X2 Z0\nPOPEN P0\n"]
    for line in range(1, LINES + 1):
        text.append(f"P1={line}\n")
        text.extend(f"G1 X2.00{move % 2} Z-0.0{move % 31:02} F800\n" for move in range(MOVES_A_LINE))
        text.append("DPRNT [LINE #1[60]]\n")
    return "".join(text) + "PCLOS\nM30\n"


class Server:
    """One dncd, kept running as a service manager does."""

    def __init__(self, name, shop, http_port, dds_port):
        self.name, self.http_port, self.dds_port = name, http_port, dds_port
        self.state = shop.folder / name
        self.command = [str(shop.programs / "dncd"), "--state", str(self.state), "--http", f"127.0.0.1:{http_port}", "--log",
                        str(shop.folder / f"{name}.log"), "--store", shop.store, "--standby", "yes", "--dds-port", str(dds_port),
                        *shop.dds_options]
        self.starts = 0
        self.process = None
        self.is_ending = threading.Event()
        self.thread = threading.Thread(target=self.keep, daemon=True)

    def keep(self):
        while not self.is_ending.is_set():
            self.starts += 1
            with open(self.state.parent / f"{self.name}.out", "ab") as out:
                self.process = subprocess.Popen(self.command, stdout=out, stderr=out)
            self.process.wait()
            self.is_ending.wait(1)

    def end(self):
        self.is_ending.set()
        if self.process is not None:
            self.process.terminate()
            self.thread.join(30)

    def ask(self, path, body=None, method=None, seconds=10):
        """Status and bytes; 0: no answer."""
        token_file = self.state / "token"
        if not token_file.exists():
            return 0, b""
        data = json.dumps(body).encode() if isinstance(body, (dict, list)) else body
        request = urllib.request.Request(f"http://127.0.0.1:{self.http_port}{path}", data, method=method or ("GET" if data is None else "POST"),
                                         headers={"Authorization": f"Bearer {token_file.read_text().strip()}", "Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=seconds) as reply:
                return reply.status, reply.read()
        except urllib.error.HTTPError as refusal:
            return refusal.code, refusal.read()
        except OSError:
            return 0, b""

    def is_active(self):
        status, body = self.ask("/api/v1/health", seconds=2)
        return status != 0 and body.startswith(b"{") and json.loads(body).get("role") == "active"

    def is_ready(self):
        return self.ask("/api/v1/ready", seconds=2)[0] == 200


class Shop:
    """Ports from `first_port` on; a DDS domain of its own."""

    def __init__(self, folder, programs, store, first_port, speed="100x", domain=87):
        self.folder, self.programs, self.store, self.speed = pathlib.Path(folder), pathlib.Path(programs), store, speed
        self.folder.mkdir(parents=True)
        self.dds_options = ["--dds-domain", str(domain), "--dds-tag", f"soak-{first_port}"]
        dds_port = 7410 + 250 * domain
        self.servers = [Server("srv-a", self, first_port, dds_port), Server("srv-b", self, first_port + 1, dds_port + 100)]
        self.lathes = {}
        self.runs = {lathe: [] for lathe in LATHES}     # ids in their order
        self.sent = {}                                  # acknowledged programs: name and SHA-256
        self.faults = []
        self.is_ending = threading.Event()
        self.work = [threading.Thread(target=self.run_lathes, daemon=True), threading.Thread(target=self.send_programs, daemon=True)]

    # --- Starting and ending ---

    def begin(self):
        first, second = self.servers
        first.state.mkdir()
        first.thread.start()
        self.wait(first.is_ready, 60, "the first server is ready")
        second.state.mkdir(mode=0o700)
        for name in ("token", "signing.key", "database.id"):
            shutil.copy(first.state / name, second.state / name)
        second.thread.start()
        servers = ",".join(f"127.0.0.1:{server.dds_port}" for server in self.servers)
        for lathe in LATHES:
            out = open(self.folder / f"{lathe}.out", "ab")
            self.lathes[lathe] = subprocess.Popen(
                [str(self.programs / "dncgw"), "--machine", lathe, "--control", "centurion", "--state", str(self.folder / lathe), "--speed", self.speed,
                 "--log", str(self.folder / f"{lathe}.log"), "--server", servers, *self.dds_options], stdout=out, stderr=out)
        self.text = program_of_lathe()
        if not self.push("O0300", self.text):
            raise RuntimeError("the lathes' program is not taken")
        for thread in self.work:
            thread.start()

    def end(self):
        self.is_ending.set()
        for gateway in self.lathes.values():
            gateway.terminate()
            gateway.wait(30)
        for server in self.servers:
            server.end()

    def wait(self, condition, seconds, what):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                raise RuntimeError(f"not within {seconds} s: {what}")
            time.sleep(0.2)

    # --- What the people do ---

    def active(self):
        return next((server for server in self.servers if server.is_active()), None)

    def push(self, name, text):
        """True: it was acknowledged."""
        server = self.active()
        if server is None:
            return False
        status, body = server.ask("/api/v1/uploads", {"program": name, "control": "centurion"})
        if status not in (200, 201):
            return False
        path = f"/api/v1/uploads/{json.loads(body)['id']}"
        data = text.encode()
        for at in range(0, len(data), PIECE):
            if server.ask(f"{path}/content?offset={at}", data[at:at + PIECE], "PUT", seconds=60)[0] != 200:
                return False
        return server.ask(path + "/commit", {}, seconds=60)[0] in (200, 201)

    def send_programs(self):
        number = 1000
        while not self.is_ending.is_set():
            number += 1
            text = f"O{number}\n(SENT AT {time.time_ns()})\nG20 G90\nG0 X1 Z0\nM30\n"
            if self.push(f"O{number}", text):
                self.sent[f"O{number}"] = hashlib.sha256(text.encode()).hexdigest()
            self.is_ending.wait(0.5)

    def run_lathes(self):
        """Each begins its program again when it has ended."""
        while not self.is_ending.is_set():
            for lathe in LATHES:
                self.go_on(lathe)
            self.is_ending.wait(1)

    def go_on(self, lathe):
        server = self.active()
        if server is None:
            return
        if self.runs[lathe]:
            status, body = server.ask(f"/api/v1/runs/{self.runs[lathe][-1]}")
            if status != 200 or json.loads(body).get("state") in ("ordered", "active"):
                return
        status, body = server.ask("/api/v1/runs", {"machine": lathe, "program": "O0300"})
        if status == 201:
            self.runs[lathe].append(json.loads(body)["id"])

    # --- What the machines do meanwhile, without a server ---

    def panel(self, lathe):
        """The machine's own panel: "ACTIVE ... text_bytes=..."."""
        done = subprocess.run([str(self.programs / "dncgw"), "panel", "--state", str(self.folder / lathe), "status"], text=True, capture_output=True,
                              timeout=10)
        return done.stdout

    def waiting_records(self, lathe):
        """In the gateway's outbox, which no server has acknowledged yet."""
        with contextlib.closing(sqlite3.connect(f"file:{self.folder / lathe / 'outbox.sqlite'}?mode=ro", uri=True, timeout=10)) as outbox:
            return outbox.execute("SELECT count(*) FROM record").fetchone()[0]

    # --- What is judged ---

    def stored_records(self, sql):
        return int(sql("SELECT count(*) FROM record"))

    def finish(self):
        """No new runs and programs; the last ones end, and everything is delivered."""
        self.is_ending.set()
        for thread in self.work:
            thread.join(120)
        server = self.servers[0] if self.servers[0].is_active() else self.servers[1]
        for lathe in LATHES:
            run = self.runs[lathe][-1]
            self.wait(lambda: json.loads(server.ask(f"/api/v1/runs/{run}")[1] or b"{}").get("state") not in ("ordered", "active"), 600, f"{run} ends")
        return server

    def judge(self, sql):
        """What was acknowledged and is not there, or is otherwise than it was: `faults`. Returns what was looked at."""
        server = self.finish()
        lines = 0
        for lathe in LATHES:
            for run in self.runs[lathe]:
                lines += self.judge_run(server, run)
        for name, digest in self.sent.items():
            status, body = server.ask(f"/api/v1/programs/{name}/content")
            if status != 200 or hashlib.sha256(body).hexdigest() != digest:
                self.faults.append(f"program {name} was acknowledged, and is not as it was sent ({status})")
        for journal in filter(None, sql("SELECT machine || ' ' || epoch || ': ' || count(*) || ' of ' || max(number) FROM record GROUP BY machine, "
                                        "epoch HAVING count(*) <> max(number) OR min(number) <> 1").splitlines()):
            self.faults.append(f"records of machine {journal}")
        status, body = server.ask("/api/v1/audit/verification", {}, seconds=120)
        if status != 200 or json.loads(body)["verification"]["fault"] is not None:
            self.faults.append(f"audit trail: {status} {body[:200]}")
        return {"runs": {lathe: len(runs) for lathe, runs in self.runs.items()}, "report_lines": lines, "records": self.stored_records(sql),
                "programs": len(self.sent), "server_starts": {server.name: server.starts for server in self.servers},
                "term": int(sql("SELECT term FROM store_holder"))}

    def judge_run(self, server, run):
        status, body = server.ask(f"/api/v1/runs/{run}")
        found = json.loads(body) if status == 200 else {}
        if found.get("state") != "completed":
            self.faults.append(f"run {run} is {found.get('state', status)}")
        status, body = server.ask(f"/api/v1/reports/{run}?format=text", seconds=60)
        lines = body.decode(errors="replace").splitlines()
        if lines != [f"LINE {number:06}" for number in range(1, LINES + 1)]:
            self.faults.append(f"run {run} has {len(lines)} report lines, {len(set(lines))} different ones, of {LINES}")
        return len(lines)
