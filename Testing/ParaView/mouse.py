# SPDX-License-Identifier: GPL-3.0-or-later
"""Clicks in windows of other programs, through the X server, as a mouse does."""

import ctypes

_PRESS, _RELEASE = 4, 5


class _ButtonEvent(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong), ("root", ctypes.c_ulong),
                ("subwindow", ctypes.c_ulong), ("time", ctypes.c_ulong), ("x", ctypes.c_int),
                ("y", ctypes.c_int), ("x_root", ctypes.c_int), ("y_root", ctypes.c_int),
                ("state", ctypes.c_uint), ("button", ctypes.c_uint), ("same_screen", ctypes.c_int),
                ("padding", ctypes.c_long * 24)]


class Mouse:
    def __init__(self):
        self._x = ctypes.CDLL("libX11.so.6")
        self._x.XOpenDisplay.restype = ctypes.c_void_p
        self._x.XDefaultRootWindow.restype = ctypes.c_ulong
        self._display = ctypes.c_void_p(self._x.XOpenDisplay(None))
        self._root = ctypes.c_ulong(self._x.XDefaultRootWindow(self._display))
        # A window may be closed while it is looked at.
        self._ignore = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda *_: 0)
        self._x.XSetErrorHandler(self._ignore)

    def _find(self, title):
        """The window with this title, or None. No window manager puts windows into others here."""
        ids, children, count = ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        self._x.XQueryTree(self._display, self._root, ctypes.byref(ids), ctypes.byref(ids),
                           ctypes.byref(children), ctypes.byref(count))
        windows = [ctypes.c_ulong(child) for child in children[:count.value]]
        self._x.XFree(children)
        for window in windows:
            name = ctypes.c_char_p()
            if self._x.XFetchName(self._display, window, ctypes.byref(name)) and name.value == title.encode():
                return window
        return None

    def _size(self, window):
        ids, place, border, depth = ctypes.c_ulong(), ctypes.c_int(), ctypes.c_uint(), ctypes.c_uint()
        width, height = ctypes.c_uint(), ctypes.c_uint()
        self._x.XGetGeometry(self._display, window, ctypes.byref(ids), ctypes.byref(place), ctypes.byref(place),
                             ctypes.byref(width), ctypes.byref(height), ctypes.byref(border),
                             ctypes.byref(depth))
        return width.value, height.value

    def click(self, title, right, bottom):
        """Clicks in the window with this title, so many pixels from its lower right corner.
        @returns whether there is such a window"""
        window = self._find(title)
        if window is None:
            return False
        width, height = self._size(window)
        for kind, state in ((_PRESS, 0), (_RELEASE, 1 << 8)):
            sent = _ButtonEvent(type=kind, display=self._display, window=window, root=self._root, time=0,
                                x=width - right, y=height - bottom, state=state, button=1, same_screen=1)
            self._x.XSendEvent(self._display, window, 1, 0, ctypes.byref(sent))
        self._x.XFlush(self._display)
        return True

