"""The live page in a browser or a notebook: sliders for parameters, and curves that change when a slider moves."""

from __future__ import annotations

import html
import webbrowser
from types import TracebackType
from typing import Any, SupportsIndex

from . import _flapwing
from ._arguments import count
from ._types import Design, Value

#: Code of the widget, which shows the live page in a frame.
_SCRIPT = """
function render({ model, el }) {
  const frame = document.createElement("iframe");
  const show = () => {
    frame.src = model.get("address");
    frame.height = model.get("height");
  };
  frame.title = "flap live";
  frame.style.cssText = "width: 100%; border: 0";
  model.on("change", show);
  show();
  el.append(frame);
}
export default { render };
"""


class Live:
    """A running server for the live page. `live` starts the server. The server stops at a call of `stop`, at the end of
    a `with` block, and at the end of Python.

    The server runs in the process that called `live`. In a forked child process, `stop` and the end of a `with` block
    have no effect on the server.

    Attributes
    ----------
    address : str
        The address of the page, with a secret token. Everybody who has the address can request rows of results from the
        server.
    """

    def __init__(self, server: _flapwing.LiveServer) -> None:
        self._server = server
        self.address: str = server.address

    def __repr__(self) -> str:
        return f"Live({self.address!r})"

    def __enter__(self) -> Live:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def _repr_html_(self) -> str:
        """Return the live page as HTML for a cell of a notebook."""
        return (
            f'<iframe title="flap live" src="{html.escape(self.address)}" height="800" '
            'style="width: 100%; border: 0"></iframe>'
        )

    def widget(self, height: SupportsIndex = 800) -> Any:
        """Return the live page as a widget of a notebook. You can display the widget, or use the widget as a part of
        larger widgets.

        The widget works in Jupyter, Visual Studio Code and marimo.

        Parameters
        ----------
        height : int, optional
            Height of the widget in pixels: 1 or more. The default of `height` is 800 pixels.

        Returns
        -------
        anywidget.AnyWidget
            The widget. The browser of the notebook must run on the same machine as the server, or must be able to reach
            the port of the server.

        Raises
        ------
        ImportError
            Raised if anywidget is not installed (``pip install anywidget``).
        ValueError
            Raised if the height is 0 or less.
        """
        try:
            import anywidget
            import traitlets
        except ImportError:
            raise ImportError("the widget requires anywidget: pip install anywidget") from None
        pixels = count("height", height)

        class Page(anywidget.AnyWidget):  # type: ignore[misc, unused-ignore]
            _esm = _SCRIPT
            address = traitlets.Unicode().tag(sync=True)
            height = traitlets.Int().tag(sync=True)

        return Page(address=self.address, height=pixels)

    def stop(self) -> None:
        """Stop the server of the live page. A live page that stays open in the browser shows that the server does not
        answer."""
        self._server.stop()


def live(
    design: Design,
    /,
    *,
    port: SupportsIndex = 0,
    open_browser: bool = False,
    threads: SupportsIndex | None = None,
    **keywords: Value,
) -> Live:
    """Start the live page of a design. On the live page you move sliders for the parameters, and the curves of the page
    change with the sliders.

    The command ``flap live`` also opens the live page of a design. In a notebook, the returned object shows the page in
    the cell. The server answers only requests from this machine, and neither reads nor writes files.

    Parameters
    ----------
    design : str, path, dict, Grid or Vehicle
        A preset, a device or a grid. For a grid with several points, the page begins with the first point and shows the
        axes.
    port : int, optional
        Port of the server, from 1 to 65535. The default of `port` is 0, which selects a free port.
    open_browser : bool, optional
        If True, the page is opened in a browser. The default of `open_browser` is False.
    threads : int, optional
        Number of worker threads: at least 1. The default of `threads` is one thread per core.
    **keywords : float or str
        Parameters of the model and solver settings, as for `run`.

    Returns
    -------
    Live
        The running server. The attribute `address` is the address of the live page.

    Raises
    ------
    ValueError, GridError, TypeError
        Raised if an argument is invalid (see `run`), or the port is not from 1 to 65535.
    OSError
        Raised if the port is in use.

    Examples
    --------
    >>> with flapwing.live("jafferis2016", hinge_stiffness="1.6 uN*m/rad") as page:
    ...     page.address.startswith("http://127.0.0.1:")
    True
    """
    number = count("port", port, least=0)
    if number > 65535:
        raise ValueError(f"`port` is {number}\nit must be from 1 to 65535, or 0 for a free port")
    page = Live(_flapwing.LiveServer(design, dict(keywords), port=number, threads=threads))
    if open_browser:
        webbrowser.open(page.address)
    return page
