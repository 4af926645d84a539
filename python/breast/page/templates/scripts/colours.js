// Eight colours that stand out on grey and differ for most kinds of colour vision; numbers say the same.
const colours = ['#ffd54a', '#56c8ff', '#ff9d5c', '#a5e05a', '#e29bff', '#ff8fa3', '#5fe0c0', '#ffffff'];
const colourOf = point => point.number ? colours[(point.number - 1) % colours.length] : '#f0f0d8';
