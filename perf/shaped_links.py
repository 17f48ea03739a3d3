"""A network of a known latency and bandwidth between namespaces of this machine, whatever queues its kernel has.

Each namespace has a device (TUN) with the address 10.213.7.(number + 1). What is sent into one is read here, held for as
long as the link would take, and written to the one that it is for. Needs root and iproute2; threads and their order are those
of one loop, which takes a few tens of microseconds a packet."""

import ctypes
import fcntl
import heapq
import multiprocessing
import os
import select
import signal
import struct
import subprocess
import time

PACKET = 9000  # bytes, as in the networks of clusters
DEVICE = "link0"
TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
CLONE_NEWNET = 0x40000000
PR_SET_TIMERSLACK = 29
libc = ctypes.CDLL(None, use_errno=True)


def name_of(number):
    return f"skein{os.getpid()}-{number}"


def address_of(number):
    return f"10.213.7.{number + 1}"


def call(*words):
    subprocess.run(words, check=True)


def enter(path):
    with open(path, encoding="ascii") as namespace:
        if libc.setns(namespace.fileno(), CLONE_NEWNET) != 0:
            raise OSError(ctypes.get_errno(), f"setns {path}")


def open_device(namespace):
    """In the namespace; this process stays where it is."""
    enter(f"/var/run/netns/{namespace}")
    device = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH", DEVICE.encode(), IFF_TUN | IFF_NO_PI))
    enter(f"/proc/{os.getppid()}/ns/net")
    return device


class Links:
    """What each namespace sends leaves by its link, one packet after the other; what it receives comes by the same, which
    takes both directions at once."""

    def __init__(self, n, latency, bandwidth):
        self.latency, self.bandwidth = latency, bandwidth
        self.free_out, self.free_in = [0.0] * n, [0.0] * n

    def find_arrival(self, now, sender, receiver, size):
        on_wire = size / self.bandwidth
        self.free_out[sender] = max(now, self.free_out[sender]) + on_wire
        # A packet that meets no other is on both links at once.
        self.free_in[receiver] = max(self.free_out[sender] + self.latency, self.free_in[receiver] + on_wire)
        return self.free_in[receiver]


def carry(namespaces, latency, bandwidth, is_ready):
    """For ever."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    libc.prctl(PR_SET_TIMERSLACK, 1000)
    # Before ranks, which look for messages without pause.
    os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(10))
    devices = [open_device(namespace) for namespace in namespaces]
    is_ready.set()
    number_of = {device: number for number, device in enumerate(devices)}
    links = Links(len(devices), latency, bandwidth)
    waiting, n_packets = [], 0
    while True:
        now = time.monotonic()
        while waiting and waiting[0][0] <= now:
            _, _, receiver, packet = heapq.heappop(waiting)
            os.write(devices[receiver], packet)
        patience = max(0.0, waiting[0][0] - time.monotonic()) if waiting else None
        for device in select.select(devices, [], [], patience)[0]:
            packet = os.read(device, PACKET + 100)
            receiver = packet[19] - 1
            # Only version 4 between these addresses; others ask who is there.
            if packet[0] >> 4 != 4 or packet[16:19] != bytes((10, 213, 7)) or not 0 <= receiver < len(devices):
                continue
            n_packets += 1
            arrival = links.find_arrival(time.monotonic(), number_of[device], receiver, len(packet))
            heapq.heappush(waiting, (arrival, n_packets, receiver, packet))


class ShapedNetwork:
    """Namespaces, in a with statement. @param latency  seconds one way  @param bandwidth  bytes / second of each link"""

    def __init__(self, n, latency, bandwidth):
        self.namespaces = [name_of(number) for number in range(n)]
        self.latency, self.bandwidth = latency, bandwidth
        self.carrier = None

    def __enter__(self):
        try:
            for namespace in self.namespaces:
                call("ip", "netns", "add", namespace)
            is_ready = multiprocessing.Event()
            arguments = (self.namespaces, self.latency, self.bandwidth, is_ready)
            self.carrier = multiprocessing.Process(target=carry, args=arguments, daemon=True)
            self.carrier.start()
            if not is_ready.wait(10.0):
                raise OSError("no device for a namespace: is there /dev/net/tun, and is this root?")
            for number, namespace in enumerate(self.namespaces):
                inside = ("ip", "-n", namespace)
                call(*inside, "address", "add", f"{address_of(number)}/24", "dev", DEVICE)
                call(*inside, "link", "set", DEVICE, "mtu", str(PACKET), "txqueuelen", "10000", "up")
                call(*inside, "link", "set", "lo", "up")
                # As clusters are set up: a link that was idle is not felt out anew.
                call("ip", "netns", "exec", namespace, "sh", "-c",
                     "echo 0 > /proc/sys/net/ipv4/tcp_slow_start_after_idle; echo reno > /proc/sys/net/ipv4/tcp_congestion_control")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if self.carrier is not None:
            self.carrier.terminate()
            self.carrier.join()
        for namespace in self.namespaces:
            subprocess.run(["ip", "netns", "delete", namespace], check=False, stderr=subprocess.DEVNULL)
