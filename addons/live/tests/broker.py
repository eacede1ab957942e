"""mosquitto at a port, by the broker.conf of a folder; a test may kill it and start it again."""
import os
import socket
import subprocess
import time


class Broker:
    def __init__(self, folder, port):
        self.folder, self.port, self.process = folder, port, None
        self.start()

    def start(self):
        self.process = subprocess.Popen(["/usr/sbin/mosquitto", "-c", os.path.join(self.folder, "broker.conf")],
                                        stderr=subprocess.DEVNULL)
        while True:
            try:
                socket.create_connection(("127.0.0.1", self.port), 1).close()
                return
            except OSError:
                time.sleep(0.05)

    def kill(self):
        self.process.kill()
        self.process.wait()
