// The parameters of the robot: what they are, and a field for each to set another value.

/** As many digits as tell robot.yaml's numbers apart. */
const text = (value) => `${Number(value.toPrecision(6))}`;

function row(parameter, set) {
  const form = document.createElement("form");
  form.noValidate = true; // the server refuses with its reason, which is shown
  form.className = "parameter";
  const label = document.createElement("label"), name = document.createElement("span");
  const input = document.createElement("input"), unit = document.createElement("span");
  const button = document.createElement("button");
  name.textContent = parameter.name;
  unit.textContent = parameter.unit;
  label.title = `${parameter.meaning}: ${text(parameter.least)} to ${text(parameter.most)}; robot.yaml: ${text(parameter.file)}` +
    (parameter.tightens_only ? "; may only be tightened" : "");
  Object.assign(input, { type: "number", min: parameter.least, max: parameter.most, step: "any", name: parameter.name });
  button.textContent = "Set";
  label.append(name, input, unit);
  form.append(label, button);
  form.onsubmit = (event) => {
    event.preventDefault();
    if (input.value !== "") set(parameter.name, Number(input.value));
    input.blur();
  };
  return { form, input };
}

export class Parameters {
  #rows = [];

  constructor(target, table, link) {
    this.table = table;
    this.#rows = table.map((parameter) => row(parameter, (name, value) => link.request("set_parameter", { parameter: name, value })));
    target.replaceChildren(...this.#rows.map(({ form }) => form));
    target.closest("details").hidden = table.length === 0;
  }

  /** A field that somebody writes in stays as it is. */
  show(values) {
    this.#rows.forEach(({ form, input }, i) => {
      if (input !== document.activeElement) input.value = text(values[i]);
      form.classList.toggle("changed", values[i] !== this.table[i].file);
    });
  }
}
