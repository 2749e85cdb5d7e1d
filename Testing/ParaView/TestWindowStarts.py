# SPDX-License-Identifier: GPL-3.0-or-later
"""Each way of loading the plugin into ParaView's window: TestWindowStarts.py PARAVIEW [PLUGIN]

ParaView loads the plugin before there is a window, while it makes that, or later. What the plugin adds to the window
works each time. Without PLUGIN, the plugin is installed, and ParaView loads it because of a configuration file."""

import os
import sys
import tempfile
from pathlib import Path

from playing import APPLY, FOLDER, SCRIPT, WINDOW, check, choose, event, play_script, run, search, version_of

PARAVIEW, *PLUGINS = sys.argv[1:]
VERSION = version_of(PARAVIEW)
SETTINGS = Path(".config/ParaView") / ("ParaView.ini" if VERSION >= (6,) else "ParaView{}.{}.{}.ini".format(*VERSION))
MANAGER = WINDOW + "PluginManagerDialog/"
FILES = MANAGER + ("1pqFileDialog0" if VERSION >= (5, 13) else "pqFileDialog")


def new_home():
    """A folder of settings without the dialog that greets new users."""
    home = Path(tempfile.mkdtemp(dir=FOLDER))
    (home / SETTINGS).parent.mkdir(parents=True)
    (home / SETTINGS).write_text("[General]\nGeneralSettings.ShowWelcomeDialog=false\n")
    return home


def use_window(home, events=(), **environment):
    """Applies filters from the menu and from the search, and closes the window."""
    shown, _ = play_script(
        [PARAVIEW], SCRIPT.format(load="", more="simple.SetActiveSource(wavelet)"),
        [*events, choose("ScatteredIsopoints"), APPLY, choose("Clip"), APPLY,
         *search(PARAVIEW, "contour samples", "Contour samples as points", "Contour samples as triangles"), APPLY],
        home=str(home), **environment)
    check(shown["ScatteredIsopoints1"] == [0, "Isopoint Splats"], f"the input of Clip is hidden: {shown}")
    check("ScatteredIsopoints2" in shown, f"the search created a filter: {shown}")


def plugin_of_a_configuration_file():
    use_window(new_home())


def plugin_of_the_search_path():
    use_window(new_home(), PV_PLUGIN_PATH=os.path.dirname(PLUGINS[0]))


def loaded_plugin_then_automatically():
    """Load New, then Auto Load in the same settings."""
    home, (plugin,) = new_home(), PLUGINS
    use_window(home, [event(WINDOW + "menubar/menuTools", "activate", "actionManage_Plugins"),
                      event(MANAGER + "splitter/localGroup/loadLocal", "activate"),
                      event(FILES, "filesSelected", plugin),
                      event(MANAGER + "buttonBox/1QPushButton0", "activate")])
    settings = (home / SETTINGS).read_text()
    own = f'filename=\\"{plugin}\\" auto_load=\\"'
    check(settings.count(own + "0") == 1, "the settings list the plugin")
    (home / SETTINGS).write_text(settings.replace(own + "0", own + "1"))
    use_window(home)


run(*([plugin_of_the_search_path, loaded_plugin_then_automatically] if PLUGINS else [plugin_of_a_configuration_file]))
