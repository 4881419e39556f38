// The text of the scene: colours, completion, sentences at their lines, undo without end.
import { autocompletion, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, isolateHistory, redo, undo } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, bracketMatching, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { Annotation, EditorState } from "@codemirror/state";
import { EditorView, drawSelection, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";

const fromOutside = Annotation.define();
const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--faint)", fontStyle: "italic" },
  { tag: tags.string, color: "var(--string)" },
  { tag: tags.number, color: "var(--number)" },
  { tag: [tags.propertyName, tags.atom, tags.bool], color: "var(--key)" },
]);

/** An editor; `changed(text, outside)` is told of every change, `complete(text, line, column)` gives what may stand. */
export function textEditor(parent, { changed, complete, nonce, label }) {
  const options = async (context) => {
    const line = context.state.doc.lineAt(context.pos);
    const word = context.matchBefore(/"?[\w.-]*/);
    if (!context.explicit && (!word || word.from === word.to)) return null;
    const found = await complete(context.state.doc.toString(), line.number, context.pos - line.from);
    return { from: word ? word.from : context.pos, options: found, validFor: /^"?[\w.-]*$/ };
  };
  const extensions = [
    lineNumbers(),
    history({ minDepth: 1000000 }),
    drawSelection(),
    highlightActiveLine(),
    bracketMatching(),
    lintGutter(),
    StreamLanguage.define(toml),
    syntaxHighlighting(colours),
    autocompletion({ override: [options] }),
    keymap.of([...completionKeymap, ...historyKeymap, ...defaultKeymap]),
    EditorView.lineWrapping,
    EditorView.contentAttributes.of({ "aria-label": label }),
    nonce ? EditorView.cspNonce.of(nonce) : [],
    EditorView.updateListener.of((update) => {
      if (!update.docChanged) return;
      const outside = update.transactions.some((one) => one.annotation(fromOutside));
      changed(update.state.doc.toString(), outside);
    }),
  ];
  const begin = (doc) => EditorState.create({ doc, extensions });
  const view = new EditorView({ parent, state: begin("") });
  return {
    get text() {
      return view.state.doc.toString();
    },
    /** Begins with a text, before which no undo goes. */
    open(text) {
      view.setState(begin(text));
      changed(text, true);
    },
    /** Puts another text in; what is the same at both ends stays, so that the cursor does. */
    put(text) {
      const now = view.state.doc.toString();
      if (now === text) return;
      let start = 0;
      while (start < Math.min(now.length, text.length) && now[start] === text[start]) start++;
      let tail = 0;
      while (tail < Math.min(now.length, text.length) - start && now.at(-1 - tail) === text.at(-1 - tail)) tail++;
      view.dispatch({
        changes: { from: start, to: now.length - tail, insert: text.slice(start, text.length - tail) },
        annotations: [fromOutside.of(true), isolateHistory.of("full")],
      });
    },
    problems(found) {
      const lines = view.state.doc.lines;
      const marks = found.filter((one) => one.line > 0).map((one) => {
        const line = view.state.doc.line(Math.min(one.line, lines));
        return { from: line.from, to: line.to, severity: "error", message: one.text };
      });
      view.dispatch(setDiagnostics(view.state, marks));
    },
    goTo(number) {
      const line = view.state.doc.line(Math.max(1, Math.min(number, view.state.doc.lines)));
      view.dispatch({ selection: { anchor: line.from }, effects: EditorView.scrollIntoView(line.from, { y: "center" }) });
      view.focus();
    },
    undo: () => undo(view),
    redo: () => redo(view),
  };
}
