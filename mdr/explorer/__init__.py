"""The explorer: a case in the browser, by sliders (`mdr explore`).

The model knows no browser: state.py is what is explored, links.py the same as text, controls.py what can be set and to
which values, pictures.py what is computed, springs.py and lines.py how that is drawn, latest.py in which thread. The
rest shows it with Bokeh and Panel, the extra `explore`: the figures in curve.py and over_period.py (canvas.py), the
controls in board.py, texts and files in keep.py, all in page.py, server.py. scripts.py is what the browser does alone.
"""
