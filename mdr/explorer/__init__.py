"""The explorer: a case in the browser, by sliders (`mdr explore`).

state.py, controls.py and pictures.py are the model, which knows no browser: what is explored, what can be set and to
which values, and what is computed of it. figures.py, page.py and server.py show it with Bokeh and Panel, the extra
`explore`.
"""
