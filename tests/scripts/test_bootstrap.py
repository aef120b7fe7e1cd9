#!/usr/bin/env python3
"""scripts/bootstrap.sh with an apt-get, a dpkg-query and a sudo that only pretend: what it says before, while and after it installs."""
import os
import pathlib
import pty
import re
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["ISOATLAS_SOURCE"])
MISSING = ["libtbb-dev", "libfmt-dev"]

# As apt-get 2.6 answers: sizes with --print-uris, else lines of APT::Status-Fd. State: the files `lists` and `installed`.
APT_GET = r'''#!/bin/bash
echo "apt-get $*" >>"$FAKE/calls"
case " $* " in
    *" --print-uris "*)
        if [[ ! -e $FAKE/lists ]]; then echo "E: Unable to locate package libtbb-dev" >&2; exit 100; fi
        echo "The following NEW packages will be installed:"
        echo "2 upgraded, 18 newly installed, 0 to remove and 3 not upgraded."
        echo "Need to get 140 MB/156 MB of archives."
        echo "After this operation, 588 MB of additional disk space will be used."
        ;;
    *" update "*)
        echo "Get:1 somewhere InRelease" && echo "dlstatus:3:57.5333:Retrieving file 3 of 4" >&3
        if [[ -e $FAKE/offline ]]; then echo "E: Failed to fetch the lists" >&2; exit 100; fi
        echo "dlstatus:4:100.0000:Retrieving file 4 of 4" >&3
        touch "$FAKE/lists"
        rm -f "$FAKE/stale"
        ;;
    *" install "*)
        for ((n = 1; n <= 20; n++)); do echo "dlstatus:$n:$((n * 5 - 5)).0000:Retrieving file $n of 20" >&3; done
        if [[ -e $FAKE/stale ]]; then echo "E: Failed to fetch libtbb-dev_1.deb  404  Not Found" >&2; exit 100; fi
        echo "dlstatus:20:100.0000:Retrieving file 20 of 20 (0s remaining)" >&3
        echo "pmstatus:dpkg-exec:0.0000:Running dpkg" >&3
        for ((n = 1; n <= 20; n++)); do echo "pmstatus:p$n:1.0:Preparing p$n (amd64)" >&3; echo "pmstatus:p$n:1.0:Unpacking p$n (amd64)" >&3; done
        if [[ -e $FAKE/broken ]]; then echo "E: Sub-process /usr/bin/dpkg returned an error code (1)" >&2; exit 100; fi
        for ((n = 1; n <= 20; n++)); do echo "pmstatus:p$n:1.0:Installed p$n (amd64)" >&3; done
        touch "$FAKE/installed"
        ;;
esac
'''
DPKG_QUERY = r'''#!/bin/bash
for package in "${@:3}"; do
    [[ " $FAKE_MISSING " == *" $package "* && ! -e $FAKE/installed ]] || echo "installed $package"
done
'''


class Bootstrap(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "scripts").mkdir()
        for name in ("bootstrap.sh", "apt_progress.sh"):
            shutil.copy(SOURCE / "scripts" / name, self.folder / "scripts")
        self.program("apt-get", APT_GET)
        self.program("dpkg-query", DPKG_QUERY)
        self.program("id", "#!/bin/sh\necho ${FAKE_USER:-0}\n")
        self.program("npm", "#!/bin/sh\n")
        # As sudo does: no descriptor but the first three, and no environment.
        self.program("sudo", '#!/bin/bash\nexec 3>&-\necho "sudo" >>"$FAKE/calls"\n[[ $1 == -n ]] && shift\nexec "$@"\n')
        self.mark("lists")
        self.environment = {"PATH": f"{self.folder / 'bin'}:/usr/bin:/bin", "FAKE": str(self.folder), "FAKE_MISSING": " ".join(MISSING), "TERM": "xterm"}

    def program(self, name, text):
        path = self.folder / "bin" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def mark(self, name):
        (self.folder / name).touch()

    def calls(self, word):
        path = self.folder / "calls"
        return [line for line in path.read_text().splitlines() if word in line.split()] if path.exists() else []

    def run_it(self, *words, **environment):
        return subprocess.run([self.folder / "scripts/bootstrap.sh", *(words or ("demo",))], env=self.environment | environment, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=120)

    def at_terminal(self, answer, *words, **environment):
        """Exit code and screen. The answer is given when the question is there, None: it must not come."""
        child, screen = pty.fork()
        if child == 0:
            os.execve(self.folder / "scripts/bootstrap.sh", ["bootstrap.sh", *words, "demo"], self.environment | environment)
        text = ""
        while True:
            try:
                piece = os.read(screen, 4096)
            except OSError:  # of a terminal whose program has ended
                break
            if not piece:
                break
            text += piece.decode()
            if answer is not None and "[Y/n]" in text:
                os.write(screen, answer.encode())
                answer = None
        os.close(screen)
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), text

    def test_nothing_is_said_when_all_is_there(self):
        self.mark("installed")
        done = self.run_it()
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(self.calls("apt-get"), [])

    def test_sizes_come_first_then_progress(self):
        done = self.run_it()
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        said = lines.index("In all 20 packages with those that they need: 140 MB to download, 588 MB more on the disk.")
        self.assertLess(lines.index("asking apt-get what they bring along ..."), said)
        progress = [line for line in lines if re.match(r"  (fetched|unpacked) ", line)]
        self.assertGreater(lines.index(progress[0]), said)
        for expected in ("fetched 10 of 20 packages, 70 of 140 MB", "fetched 20 of 20 packages, 140 of 140 MB",
                         "unpacked 20, set up 20 of 20 packages"):
            self.assertTrue(any(expected in line for line in progress), (expected, progress))
        self.assertLessEqual(len(progress), 24)  # a line for each tenth part, not one for each package
        self.assertRegex(lines[-1], r"^installed 20 packages in \d+ s$")
        self.assertEqual(len([line for line in self.calls("install") if "--print-uris" not in line]), 1)

    def test_fresh_image_gets_its_lists_first(self):
        (self.folder / "lists").unlink()
        done = self.run_it()
        self.assertEqual(done.returncode, 0, done.stderr)
        text = done.stdout
        self.assertLess(text.index("package lists: 57 %"), text.index("In all 20 packages"))
        self.assertEqual(len(self.calls("update")), 1)

    def test_stale_lists_are_fetched_and_it_is_tried_again(self):
        self.mark("stale")
        done = self.run_it()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("once more with new package lists", done.stdout)

    def test_no_network(self):
        (self.folder / "lists").unlink()
        self.mark("offline")
        done = self.run_it()
        self.assertEqual(done.returncode, 2)
        self.assertIn("E: Failed to fetch the lists", done.stderr)
        self.assertIn("Check the network and /etc/apt", done.stderr)
        self.assertEqual([line for line in self.calls("install") if "--print-uris" not in line], [])

    def test_failure_shows_what_apt_said_and_keeps_it(self):
        self.mark("broken")
        done = self.run_it()
        self.assertEqual(done.returncode, 2)
        self.assertIn("E: Sub-process /usr/bin/dpkg returned an error code (1)", done.stderr)
        log = self.folder / "build/bootstrap.log"
        self.assertIn(str(log), done.stderr)
        self.assertIn("Sub-process", log.read_text())
        self.assertIn(f"apt-get install --yes --no-install-recommends {' '.join(MISSING)}", done.stderr)

    def test_apt_that_installs_nothing_is_no_success(self):
        self.program("apt-get", APT_GET.replace('touch "$FAKE/installed"', ":"))
        done = self.run_it()
        self.assertEqual(done.returncode, 2)
        self.assertIn("libtbb-dev libfmt-dev are missing", done.stderr)

    def test_terminal_is_asked(self):
        for answer, expected in (("\n", 0), ("y\n", 0), ("n\n", 2), ("what\n", 2), ("\x04", 2)):
            with self.subTest(answer=answer):
                (self.folder / "installed").unlink(missing_ok=True)
                code, screen = self.at_terminal(answer)
                self.assertEqual(code, expected, screen)
                self.assertLess(screen.index("In all 20 packages"), screen.index("Install them? [Y/n]"))
                self.assertEqual((self.folder / "installed").exists(), expected == 0)
                if expected == 0:
                    self.assertIn("\r  fetched 20 of 20 packages, 140 of 140 MB", screen)
                else:
                    self.assertIn("nothing was installed", screen)

    def test_nothing_is_asked_with_yes_and_in_ci(self):
        for words, environment in ((("--yes",), {}), ((), {"ISOATLAS_YES": "1"}), ((), {"CI": "true"})):
            with self.subTest(words=words, environment=environment):
                (self.folder / "installed").unlink(missing_ok=True)
                code, screen = self.at_terminal(None, *words, **environment)
                self.assertEqual(code, 0, screen)
                self.assertNotIn("[Y/n]", screen)

    def test_user_with_sudo(self):
        done = self.run_it(FAKE_USER="1000")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("fetched 20 of 20 packages", done.stdout)
        self.assertTrue(self.calls("sudo"))

    def test_user_without_sudo_gets_the_command(self):
        self.program("sudo", "#!/bin/sh\nexit 1\n")
        done = self.run_it(FAKE_USER="1000")
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"apt-get update && apt-get install --yes --no-install-recommends {' '.join(MISSING)}", done.stderr)
        self.assertEqual(self.calls("apt-get"), [])


if __name__ == "__main__":
    unittest.main()
