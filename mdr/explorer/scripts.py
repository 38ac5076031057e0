"""What the browser does by itself: names for those who hear the page, the history of states, copies."""

#: a slider is named as its box and says what stands there, which no widget does; what is only shown cannot be changed
NAMES = """
const boxes = {}, sliders = {};
(function walk(root) {
  for (const one of root.querySelectorAll('*')) {
    const path = one.classList[one.classList.length - 1];
    if (one.matches('.box')) boxes[path] = one.shadowRoot;
    if (one.matches('.slider')) sliders[path] = one.shadowRoot;
    if (one.matches('.shown')) one.shadowRoot.querySelector('input, textarea').readOnly = true;
    if (one.matches('.upload')) one.shadowRoot.querySelector('input').setAttribute('aria-label', 'load a case');
    if (one.shadowRoot) walk(one.shadowRoot);
  }
})(document);
for (const path in sliders) {
  const handle = sliders[path].querySelector('[role=slider]'), box = boxes[path];
  handle.setAttribute('aria-label', box ? box.querySelector('label').innerText : path);
  if (box) handle.setAttribute('aria-valuetext', box.querySelector('input').value);
}
"""
#: the address is that of the state: the first takes the place of an address without one; what follows on a change
#: within a second, as while one drags, is the same step of the history
LINK = """
const link = new URL(cb_obj.value || location.pathname, location.href).href, now = Date.now();
const begins = location.search === '', step = !begins && link !== location.href && now - (window.mdr_last || 0) > 1000;
history[step ? 'pushState' : 'replaceState'](null, '', link);
window.mdr_last = begins ? 0 : now;
back.value = '';
window.onpopstate = () => { back.value = location.search; };
"""
#: copy, and say whether it was allowed
COPY = """
const label = button.label, say = words => {
  button.label = words;
  setTimeout(() => { button.label = label; }, 1500);
};
navigator.clipboard.writeText(text.value).then(() => say('Copied ✓'), () => say('Not allowed: select and copy it'));
"""
