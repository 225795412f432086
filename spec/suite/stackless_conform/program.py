"""The program under test, which receives one case at a time."""

import json
import os
import queue
import signal
import subprocess
import sys
import threading
import time

from .judge import Flaw, judge, read_hello, read_reply, shown

MOST_BYTES = 64 << 20  # of a line; a longer line is invalid


class Program:
    """A running program. Its child processes end with it, on systems with process groups."""

    def __init__(self, command, passes_errors):
        errors = None if passes_errors else subprocess.PIPE
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": errors}
        self.child = subprocess.Popen(command, start_new_session=True, **pipes)
        self.lines = queue.Queue(4)
        threading.Thread(target=self.listen, daemon=True).start()
        self.said, self.has_said = b"", threading.Thread(target=self.listen_to_errors, daemon=True)
        self.has_said.start()

    def listen(self):
        for line in iter(lambda: self.child.stdout.readline(MOST_BYTES), b""):
            self.lines.put(line)
        self.lines.put(None)

    def listen_to_errors(self):
        """Keeps the last line that is not empty: usually the reason. Reads everything, so that the program never blocks."""
        errors = self.child.stderr
        for line in iter(lambda: errors.readline(1 << 12), b"") if errors else ():
            self.said = line.strip() or self.said

    def how_it_ended(self):
        """Returns the exit status, and the last line of standard error. The program may run on with its output closed."""
        try:
            how = f"exit status: {self.child.wait(0.1)}"
        except subprocess.TimeoutExpired:
            how = "its output is closed"
        self.has_said.join(0.2)  # a child process may keep standard error open
        said = f"; its standard error ends with: {shown(self.said.decode(errors='replace'))}" if self.said else ""
        return how + said

    def ask(self, request, timeout):
        """Returns the answer, or None if the program has ended. Raises TimeoutError if no answer comes in time."""
        try:
            self.child.stdin.write(json.dumps(request, separators=(",", ":")).encode() + b"\n")
            self.child.stdin.flush()
            if request["cmd"] == "bye":
                self.child.stdin.close()
        except OSError:
            pass  # it has ended; the queue reports this
        try:
            return self.lines.get(timeout=timeout)
        except queue.Empty:
            raise TimeoutError from None

    def end(self):
        try:
            os.killpg(self.child.pid, signal.SIGKILL)
        except (AttributeError, ProcessLookupError, PermissionError):
            self.child.kill()
        self.child.wait()


class Run:
    def __init__(self, args):
        self.args, self.program, self.hello, self.deadline = args, None, None, time.monotonic() + args.budget
        self.is_starting, self.status = False, None

    def terminate(self, signal, _):
        """Does not exit while a program starts: until `self.program` is set, `stop` could not end it."""
        self.status = 128 + signal
        if not self.is_starting:
            sys.exit(self.status)

    def start(self):
        self.is_starting = True
        try:
            self.program = Program(self.args.command, self.args.stderr)
        finally:
            self.is_starting = False
        if self.status:
            sys.exit(self.status)
        line = self.program.ask({"cmd": "hello", "protocol": 1}, self.args.timeout)
        if line is None:
            raise ValueError(f"no hello: the program ended: {self.program.how_it_ended()}")
        try:
            return read_hello(line)
        except ValueError as error:
            raise ValueError(f"no hello: {shown(str(error))} in {shown(line.decode(errors='replace'))}") from None

    def stop(self):
        if self.program:
            self.program.end()
        self.program = None

    def bye(self):
        """Says goodbye. Returns the faults: further output, or no exit."""
        try:
            if self.program and self.program.ask({"cmd": "bye"}, self.args.timeout) is not None:
                return ["wrote more than was asked"]
        except TimeoutError:
            return ["the program does not end after 'bye'"]
        finally:
            self.stop()
        return []

    def ask(self, seq, profile, case):
        """Returns the outcome, the fault or None, and the answer if it is a valid one that fails."""
        level, name = profile.split("/")
        request = {"cmd": "case", "seq": seq, "level": level, "profile": name, "input": case["input"]}
        if time.monotonic() > self.deadline:
            return "error", f"given up: the run has taken {self.args.budget:g} s", None
        try:
            if not self.program:
                self.start()
            line = self.program.ask(request, self.args.timeout)
        except TimeoutError:
            self.stop()
            return "timeout", "no answer in time (is every line flushed?)", None
        except (OSError, ValueError) as error:
            self.stop()
            return "error", shown(str(error)), None
        if line is None:
            how = self.program.how_it_ended()
            self.stop()
            return "crash", f"the program ended: {how}", None
        try:
            reply = read_reply(line, seq)
        except ValueError as error:
            self.stop()
            return "error", f"{shown(str(error))} in {shown(line.decode(errors='replace'))}", None
        try:
            judge(case, self.hello, reply)
        except Flaw as flaw:
            return "fail", str(flaw), reply
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            return "fail", f"not as it must be: {shown(repr(error))}", reply
        return "pass", None, None
