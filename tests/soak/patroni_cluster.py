"""Three etcd and three Patroni with PostgreSQL on this computer's loopback, each node's end and silence the caller's.

The settings that are tested here are those of deploy/docs/operations.md. Processes of PostgreSQL and Patroni run as the user postgres.
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import urllib.error
import urllib.request

NAMES = ("one", "two", "three")
DCS = {
    "ttl": 20,
    "loop_wait": 2,
    "retry_timeout": 8,
    "maximum_lag_on_failover": 1048576,
    "synchronous_mode": True,
    "synchronous_mode_strict": True,
    "postgresql": {
        "use_pg_rewind": True,
        "use_slots": True,
        "parameters": {
            "max_connections": 100,
            "shared_buffers": "128MB",
            "max_wal_size": "1GB",
            "wal_keep_size": "512MB",
            "wal_log_hints": "on",
            "tcp_user_timeout": 10000,
            "tcp_keepalives_idle": 5,
            "tcp_keepalives_interval": 2,
            "tcp_keepalives_count": 3,
            "wal_sender_timeout": 10000,
            "wal_receiver_timeout": 10000,
        },
    },
}


def as_postgres():
    return ["setpriv", "--reuid=postgres", "--regid=postgres", "--clear-groups"] if os.geteuid() == 0 else []


def eventually(condition, seconds, every=0.1):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(every)
    return False


class Cluster:
    """Ports from `first_port` on: of node n PostgreSQL, Patroni, etcd's clients and etcd's peers."""

    def __init__(self, folder, first_port):
        self.folder = pathlib.Path(folder)
        self.first_port = first_port
        self.bin = sorted(pathlib.Path("/usr/lib/postgresql").glob("*/bin"))[-1]
        self.etcd, self.patroni = {}, {}
        self.frozen = []
        self.folder.mkdir(parents=True)
        if os.geteuid() == 0:
            shutil.chown(self.folder, "postgres", "postgres")

    # --- Where it is ---

    def port(self, node, what):
        return self.first_port + 4 * NAMES.index(node) + ("postgresql", "patroni", "client", "peer").index(what)

    def url(self, database="dripline"):
        hosts = ",".join(f"127.0.0.1:{self.port(node, 'postgresql')}" for node in NAMES)
        return f"postgresql://postgres@{hosts}/{database}"

    # --- Starting and ending ---

    def start_etcd(self, node):
        members = ",".join(f"{other}=http://127.0.0.1:{self.port(other, 'peer')}" for other in NAMES)
        client, peer = (f"http://127.0.0.1:{self.port(node, what)}" for what in ("client", "peer"))
        self.etcd[node] = self.start(f"etcd-{node}", [
            "etcd", "--name", node, "--data-dir", str(self.folder / f"etcd-{node}"), "--listen-client-urls", client, "--advertise-client-urls",
            client, "--listen-peer-urls", peer, "--initial-advertise-peer-urls", peer, "--initial-cluster", members, "--initial-cluster-state",
            "new", "--heartbeat-interval", "200", "--election-timeout", "2000", "--enable-v2", "--logger", "zap"])

    def start_patroni(self, node):
        config = self.folder / f"{node}.yml"
        config.write_text(json.dumps({  # JSON is YAML
            "scope": "dripline", "name": node,
            "restapi": {"listen": f"127.0.0.1:{self.port(node, 'patroni')}"},
            # Not etcd3: with it Patroni before 3.0.3 writes its name over its successor's when it wakes up after `ttl`, and what that one has
            # acknowledged is lost.
            "etcd": {"hosts": [f"127.0.0.1:{self.port(other, 'client')}" for other in NAMES]},
            "bootstrap": {"dcs": DCS, "initdb": [{"encoding": "UTF8"}, {"locale": "C"}, "data-checksums"],
                          "pg_hba": ["host all all 127.0.0.1/32 trust", "host replication all 127.0.0.1/32 trust", "local all all trust"]},
            "postgresql": {"listen": f"127.0.0.1:{self.port(node, 'postgresql')}", "connect_address": f"127.0.0.1:{self.port(node, 'postgresql')}",
                           "data_dir": str(self.folder / f"data-{node}"), "bin_dir": str(self.bin),
                           "authentication": {"superuser": {"username": "postgres"}, "replication": {"username": "postgres"}},
                           "pgpass": str(self.folder / f"pgpass-{node}"), "parameters": {"unix_socket_directories": str(self.folder)}},
        }, indent=1))
        self.patroni[node] = self.start(f"patroni-{node}", ["/usr/bin/python3", "/usr/bin/patroni", str(config)])

    def start(self, name, command):
        log = open(self.folder / f"{name}.log", "ab")
        return subprocess.Popen([*as_postgres(), *command], stdin=subprocess.DEVNULL, stdout=log, stderr=log, cwd=self.folder,
                                start_new_session=True)

    def begin(self, seconds=120):
        for node in NAMES:
            self.start_etcd(node)
        for node in NAMES:
            self.start_patroni(node)
        if not eventually(self.is_whole, seconds, 0.5):
            raise RuntimeError("the cluster is not whole: " + json.dumps(self.states()))
        if not eventually(lambda: self.try_sql("SELECT 1", "postgres"), 30):
            raise RuntimeError("the cluster does not answer")
        self.sql("CREATE DATABASE dripline ENCODING 'UTF8' TEMPLATE template0", "postgres")
        eventually(lambda: self.try_sql("SELECT 1"), 30)  # libpq tries no other host when a replica has not replayed it yet

    def end(self):
        self.thaw()
        for process in list(self.patroni.values()):
            kill_group(process)
        for node in NAMES:
            self.kill_postgresql(node)
        for process in self.etcd.values():
            kill_group(process)

    def postmaster(self, node):
        try:
            return int((self.folder / f"data-{node}" / "postmaster.pid").read_text().split()[0])
        except (OSError, ValueError, IndexError):
            return None

    def kill_postgresql(self, node):
        pid = self.postmaster(node)
        if pid is None:
            return
        for process in [pid, *children(pid)]:
            signal_to(process, signal.SIGKILL)

    # --- What is done to a node ---

    def kill(self, node):
        """The node's computer loses its power: PostgreSQL and Patroni end at once."""
        kill_group(self.patroni[node])
        self.kill_postgresql(node)

    def freeze(self, node):
        """PostgreSQL and Patroni of the node answer nothing, and close nothing."""
        pid = self.postmaster(node)
        self.frozen = [process for process in (self.patroni[node].pid, *children(self.patroni[node].pid), pid, *children(pid)) if process]
        for process in self.frozen:
            signal_to(process, signal.SIGSTOP)

    def thaw(self):
        for process in self.frozen:
            signal_to(process, signal.SIGCONT)
        self.frozen = []

    def lose_majority(self):
        """Two of three etcd lose their power."""
        for node in NAMES[1:]:
            kill_group(self.etcd[node])

    def find_majority(self):
        for node in NAMES[1:]:
            self.start_etcd(node)

    def rebuild(self, node):
        """`patronictl reinit`: for a replica that does not recover."""
        body = json.dumps({"force": True}).encode()
        request = urllib.request.Request(f"http://127.0.0.1:{self.port(node, 'patroni')}/reinitialize", body, {"Content-Type": "application/json"})
        try:
            urllib.request.urlopen(request, timeout=60).close()
        except OSError:
            pass

    def lost_replicas(self):
        """Those that stream from no primary."""
        found = self.primaries()
        links = self.ask(found[0], "/patroni").get("replication", []) if len(found) == 1 else []
        streaming = {link.get("application_name") for link in links if link.get("state") == "streaming"}
        return [node for node in NAMES if found and node not in found and node not in streaming]

    def switch_over(self, leader):
        """Planned, to the synchronous replica. False: Patroni refuses it, which just after a change it does."""
        body = json.dumps({"leader": leader, "candidate": self.synchronous()}).encode()
        request = urllib.request.Request(f"http://127.0.0.1:{self.port(leader, 'patroni')}/switchover", body, {"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=60) as reply:
                return reply.status == 200
        except urllib.error.HTTPError:
            return False

    # --- What is seen ---

    def ask(self, node, path):
        """What Patroni of the node answers; {}: nothing."""
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.port(node, 'patroni')}{path}", timeout=1) as reply:
                return json.load(reply)
        except urllib.error.HTTPError as refusal:
            return json.loads(refusal.read() or b"{}")
        except (OSError, ValueError):
            return {}

    def states(self):
        return {node: self.ask(node, "/patroni") for node in NAMES}

    def primaries(self):
        return [node for node, state in self.states().items() if state.get("role") == "master" and state.get("state") == "running"]

    def synchronous(self):
        """The node that Patroni would promote: what it has written down, which is later than what PostgreSQL does."""
        members = next(filter(None, (self.ask(node, "/cluster") for node in NAMES)), {}).get("members", [])
        return next((member["name"] for member in members if member["role"] == "sync_standby"), None)

    def is_whole(self):
        found = self.primaries()
        links = self.ask(found[0], "/patroni").get("replication", []) if len(found) == 1 else []
        return sum(link.get("state") == "streaming" for link in links) == len(NAMES) - 1 and self.synchronous() is not None

    def try_sql(self, text, database="dripline"):
        """None: there is no primary."""
        try:
            return self.sql(text, database)
        except (RuntimeError, subprocess.TimeoutExpired):
            return None

    def sql(self, text, database="dripline"):
        """One answer as text, from whichever is the primary."""
        done = subprocess.run([str(self.bin / "psql"), self.url(database) + "?target_session_attrs=read-write&connect_timeout=3", "-XqAtc", text],
                              text=True, capture_output=True, timeout=60)
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip())
        return done.stdout.strip()


def children(pid):
    if pid is None:
        return []
    found = subprocess.run(["pgrep", "-P", str(pid)], text=True, capture_output=True).stdout.split()
    return [process for child in map(int, found) for process in (child, *children(child))]


def signal_to(pid, number):
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


def kill_group(process):
    """SIGKILL: nothing is tidied up."""
    for pid in (process.pid, *children(process.pid)):
        signal_to(pid, signal.SIGKILL)
    process.wait()
