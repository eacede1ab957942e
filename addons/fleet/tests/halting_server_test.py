#!/usr/bin/python3
"""halting_server_test.py STREAM_READER: a stream is read while its server halts again and again for longer than the reader waits, so that
answers to older requests come with those to newer ones."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from servers import Nats, free_ports  # noqa: E402

READER = os.path.abspath(sys.argv[1])
MESSAGES = 12_000


class HaltingServer(unittest.TestCase):
    def test_every_message_comes_once_and_in_order(self):
        folder = tempfile.mkdtemp(prefix="spoolflow-halting-")
        server = Nats(folder, free_ports(1)[0])
        try:
            reader = subprocess.Popen([READER, f"nats://127.0.0.1:{server.port}", str(MESSAGES)], text=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual(reader.stdout.readline(), "filled\n", reader.poll() is not None and reader.stderr.read())
            halts = 0
            while reader.poll() is None and halts < 300:
                server.process.send_signal(signal.SIGSTOP)
                time.sleep(0.13)
                server.process.send_signal(signal.SIGCONT)
                time.sleep(0.005)
                halts += 1
            said, complained = reader.communicate(timeout=60)
            self.assertEqual((reader.returncode, complained), (0, ""), f"behind {halts} halts")
            self.assertRegex(said, "read by [0-9]+ readers")
            self.assertGreater(halts, 2)
        finally:
            server.stop()
            shutil.rmtree(folder)

    def test_a_server_without_room_for_the_stream_is_told_apart(self):
        folder = tempfile.mkdtemp(prefix="spoolflow-full-")
        server = Nats(folder, free_ports(1)[0], room="1GB")
        try:
            reader = subprocess.run([READER, f"nats://127.0.0.1:{server.port}", "1"], text=True, capture_output=True, timeout=60,
                                    check=False)
            self.assertEqual(reader.returncode, 1)
            self.assertIn("no room for the stream", reader.stderr)
            self.assertIn("of 4000 MB (replicas: 1)", reader.stderr)
        finally:
            server.stop()
            shutil.rmtree(folder)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
