"""Ports for servers that a test ends and starts again at the same place."""
import random
import socket

_reserved = []  # names of this process, which no other test takes while it runs


def _ephemeral():
    """From where on the kernel gives ports away by itself."""
    try:
        with open("/proc/sys/net/ipv4/ip_local_port_range", encoding="utf-8") as file:
            return int(file.readline().split()[0])
    except OSError:
        return 32768


def free_ports(count):
    """Below those that the kernel gives away: of these a port is lost to any connection, even to one that a client makes to itself, while its
    server is away. No other test that asks here gets one of them."""
    ports = []
    while len(ports) < count:
        port = random.SystemRandom().randrange(10000, max(_ephemeral(), 12000))
        name = socket.socket(socket.AF_UNIX)
        try:
            name.bind(f"\0spoolflow-test-port-{port}")
            with socket.socket() as one:
                one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
                one.bind(("127.0.0.1", port))
        except OSError:
            name.close()
            continue
        _reserved.append(name)
        ports.append(port)
    return ports
