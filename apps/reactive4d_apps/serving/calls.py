"""Calls: what a process may ask the system for, bounded by the system itself: Linux, on a processor that is known.

A filter of system calls refuses new processes, other programs, sockets, and whatever changes a folder. It stays in
force whatever runs afterwards, for a user who may do anything too.
"""

import ctypes
import platform
import struct
import sys

__all__ = ["filtered"]

# By the machine's name: its number, the numbers of calls that are refused, and of that which starts a thread.
MACHINES = {
    "x86_64": (
        0xC000003E,
        # socket, connect, bind, fork, vfork, execve, truncate, rename, mkdir, rmdir, link, unlink, symlink, chmod,
        # chown, lchown, ptrace, mknod, mkdirat, mknodat, fchownat, unlinkat, renameat, linkat, symlinkat, fchmodat,
        # renameat2, process_vm_readv, process_vm_writev, execveat, io_uring_setup, openat2 for what it may hide
        (41, 42, 49, 57, 58, 59, 76, 82, 83, 84, 86, 87, 88, 90, 92, 94, 101, 133, 258, 259, 260, 263, 264, 265, 266,
         268, 310, 311, 316, 322, 425, 437),
        56,
    ),
    "aarch64": (
        0xC00000B7,
        (33, 34, 35, 36, 37, 38, 45, 53, 54, 117, 198, 200, 203, 221, 270, 271, 276, 281, 425, 437),
        220,
    ),
}  # fmt: skip
CLONE3 = 435
CLONE_THREAD = 0x10000
FOREIGN = 0x40000000  # numbers from here on are another processor's way to call
_LOAD, _EQUAL, _AT_LEAST, _HAS, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_ALLOW, _REFUSE, _ABSENT = 0x7FFF0000, 0x00050001, 0x00050026  # the latter: there is no such call
_NO_NEW_RIGHTS, _SET_FILTER, _BY_PROGRAM = 38, 22, 2


class _Program(ctypes.Structure):
    _fields_ = [("length", ctypes.c_ushort), ("steps", ctypes.c_void_p)]


def filtered() -> bool:
    """Bound this process from now on, and say whether the system does."""
    known = MACHINES.get(platform.machine()) if sys.platform == "linux" and sys.maxsize > 2**32 else None
    if known is None:
        return False
    steps = _steps(*known)
    held = ctypes.create_string_buffer(steps, len(steps))
    program = _Program(len(steps) // 8, ctypes.cast(held, ctypes.c_void_p))
    system = ctypes.CDLL(None)
    if system.prctl(_NO_NEW_RIGHTS, 1, 0, 0, 0) != 0:
        return False
    return bool(system.prctl(_SET_FILTER, _BY_PROGRAM, ctypes.byref(program)) == 0)


def _steps(machine: int, refused: tuple[int, ...], clone: int) -> bytes:
    """The filter: what is loaded is compared, and what is refused leads to the end."""
    checks: list[tuple[int, str, int]] = [
        (_AT_LEAST, "refuse", FOREIGN),
        *((_EQUAL, "refuse", number) for number in refused),
        (_EQUAL, "absent", CLONE3),  # whose flags cannot be seen; the library falls back on the older one
    ]
    # After the checks: is it a new thread? Then: allow, refuse, absent.
    length = len(checks) + 3
    ends = {"allow": length + 3, "refuse": length + 4, "absent": length + 5}
    program = [
        _step(_LOAD, 4),  # which processor it is
        _step(_EQUAL, machine, no=ends["refuse"] - 2),
        _step(_LOAD, 0),  # which call it is
        *[_step(kind, value, yes=ends[end] - at - 1) for at, (kind, end, value) in enumerate(checks, 3)],
        _step(_EQUAL, clone, no=ends["allow"] - length - 1),
        _step(_LOAD, 16),  # with which flags
        _step(_HAS, CLONE_THREAD, yes=ends["allow"] - length - 3, no=ends["refuse"] - length - 3),
        _step(_RETURN, _ALLOW),
        _step(_RETURN, _REFUSE),
        _step(_RETURN, _ABSENT),
    ]
    return b"".join(program)


def _step(kind: int, value: int, *, yes: int = 0, no: int = 0) -> bytes:
    return struct.pack("HBBI", kind, yes, no, value)
